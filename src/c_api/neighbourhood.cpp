#include "lkao/c/neighbourhood.h"

#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/versioned.h"

using namespace lkao::c_api;

lkao_status lkao_neighbourhood_create(const lkao_ao* ao, const lkao_bounds* positions,
                                      lkao_neighbourhood** neighbourhood) {
  return create(__func__, neighbourhood, "neighbourhood", [&] {
    const lkao::AmbientOcclusion& found = object(ao, "ao");
    const float *lower = needed(positions, "positions")->lower, *upper = positions->upper;
    return PatternedNeighbourhood{found.pattern(),
                                  found.around({{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}})};
  });
}

lkao_status lkao_neighbourhood_destroy(lkao_neighbourhood* neighbourhood) {
  return destroy(__func__, neighbourhood, "neighbourhood");
}

lkao_status lkao_neighbourhood_query(lkao_neighbourhood* neighbourhood, const lkao_receiver* receiver, uint64_t index,
                                     lkao_answer* answer) {
  return guard(__func__, [&] {
    check_size(answer, "answer");
    PatternedNeighbourhood& found = object(neighbourhood, "neighbourhood");
    write(c_answer_of(found.neighbourhood.query(receiver_of(receiver), index)), answer);
  });
}

lkao_status lkao_neighbourhood_blocked(lkao_neighbourhood* neighbourhood, const lkao_receiver* receiver, uint64_t index,
                                       uint64_t* mask, size_t word_count) {
  return guard(__func__, [&] {
    PatternedNeighbourhood& found = object(neighbourhood, "neighbourhood");
    check_mask(found.pattern, mask, word_count);
    write_mask(found.neighbourhood.blocked(receiver_of(receiver), index), found.pattern, mask, word_count);
  });
}
