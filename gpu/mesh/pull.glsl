// Vertex pulling: which triangle of the list a vertex belongs to. An instance is a batch of triangles.
#include "gpu/mesh/occluder.glsl"

// False past the end of the list.
bool find_triangle(int vertices_per_triangle, int count_word, out uint triangle, out int vertex) {
  int index = gl_InstanceID * LKAO_BATCH_SIZE + gl_VertexID / vertices_per_triangle;
  vertex = gl_VertexID % vertices_per_triangle;
  if (uint(index) >= texelFetch(draws, count_word).x) return false;
  triangle = texelFetch(list, index).x;
  return true;
}
