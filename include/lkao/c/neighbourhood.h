// Queries of receivers that lie near each other (lkao::Neighbourhood).
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// For renderers that shade point by point, one for each tile of the image: queries of receivers in its box are faster,
// and the same. For one thread at a time; different ones may be used in different threads.
typedef struct lkao_neighbourhood lkao_neighbourhood;

// `positions` is a box around the receivers, which must not be empty. Takes some microseconds.
LKAO_C_API lkao_status lkao_neighbourhood_create(const lkao_ao* ao, const lkao_bounds* positions,
                                                 lkao_neighbourhood** neighbourhood);
LKAO_C_API lkao_status lkao_neighbourhood_destroy(lkao_neighbourhood* neighbourhood);

// As lkao_ao_query and lkao_ao_blocked. A receiver outside of the box is answered, too, but no faster.
LKAO_C_API lkao_status lkao_neighbourhood_query(lkao_neighbourhood* neighbourhood, const lkao_receiver* receiver,
                                                uint64_t index, lkao_answer* answer);
LKAO_C_API lkao_status lkao_neighbourhood_blocked(lkao_neighbourhood* neighbourhood, const lkao_receiver* receiver,
                                                  uint64_t index, uint64_t* mask, size_t word_count);

#ifdef __cplusplus
}
#endif
