// What goes from a volume to its fragments: VARYING is `out` or `in`.
VARYING VolumeShape {
  flat vec3 a, b, c;
  flat vec3 base_a, base_b, base_c;
  flat vec3 normal;
  flat float opacity;
} shape;
