// To count the fragments of bounding shapes.
void main() {}
