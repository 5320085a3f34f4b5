// What goes from a shape to its fragments: VARYING is `out` or `in`.
VARYING Shape {
  flat vec3 a, b, c;
  flat vec3 normal;
  flat vec4 sphere;
  flat float nearest_depth;
  flat vec2 range;
} shape;
