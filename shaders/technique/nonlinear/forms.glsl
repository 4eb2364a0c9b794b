// The ways in which a triangle is drawn.
const uint FORM_SQUARES = 0u;   // of the image, exact
const uint FORM_OUTLINED = 1u;  // a polygon around it, exact
const uint FORM_STRAIGHT = 2u;  // by the rasterizer alone, from its projected corners

// What bends less than a rasterizer rounds, and is short enough for what lies between its corners to be interpolated.
const float STRAIGHT_BULGE = 1.0 / 512.0;  // px across edges
const float STRAIGHT_SLIP = 1.0 / 32.0;    // px along them
const float STRAIGHT_ANGLE = 0.009;        // radians; 1 / distance is then off by 1e-5 of itself
// By this much, px, exact triangles reach over edges that a straight triangle may share, whose corners are rounded.
const float EDGE_OVERLAP = 1.0 / 128.0;

// Polygons around triangles reach this much farther than they need to, px: far more than single precision and
// rasterizers move a corner.
const float SQUARE_MARGIN = 0.0625;

// In the place of a node's number: the triangle's own outline.
const uint OUTLINE = 0x40000000u;
