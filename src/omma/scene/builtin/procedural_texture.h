// Pictures painted by code: they repeat without a seam, and are the same on every machine.
#pragma once

#include "omma/scene/builtin/canvas.h"

namespace omma::builtin {

Texture paint_asphalt();
Texture paint_road();  ///< across: u; centre line and edges painted; v repeats every 8 m of 14
Texture paint_crossing();
Texture paint_pavement();
Texture paint_grass();
Texture paint_brick_windows();    ///< 4 windows wide, 4 storeys high
Texture paint_plaster_windows();  ///< 4 windows wide, 4 storeys high
Texture paint_glass_front();      ///< 4 panes wide, 4 storeys high
Texture paint_shopfront();        ///< 4 shops wide, one storey high
Texture paint_concrete();
Texture paint_roof_tiles();
Texture paint_bark();
Texture paint_leaves();
Texture paint_metal(const glm::vec3& color);
Texture paint_bricks();
Texture paint_stone();  ///< ashlar blocks
Texture paint_marble();
Texture paint_wood();
Texture paint_checker();
Texture paint_plaster();
Texture paint_cloth();
Texture paint_ground();  ///< grey detail for terrain, whose colour is in the vertices

}  // namespace omma::builtin
