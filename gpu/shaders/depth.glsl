// The pass's own depth: 1 at the camera, falling with distance, so that the far side of a volume passes where its depth is
// less than the receiver's. Its range does not depend on the camera's near and far planes.
float depth_at(float along_view) {
  return has_flag(LKAO_FLAG_PERSPECTIVE) ? pass.depth_map.x / along_view
                                         : (pass.depth_map.x - along_view) * pass.depth_map.y;
}
