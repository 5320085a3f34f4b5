// The plane mask table: which rays of a sample pattern end beyond a plane, by one look-up (lkao::PlaneMaskTable).
#pragma once

#include "lkao/c/pattern.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_table lkao_table;

// How a plane finds its cell (lkao/plane_addressing.h).
typedef int32_t lkao_plane_addressing;
enum { LKAO_ADDRESSING_CUBE = 0, LKAO_ADDRESSING_SLICES = 1 };

// What is kept for each cell.
typedef int32_t lkao_plane_masks;
enum {
  LKAO_MASKS_NEAREST = 0,  // the mask of the plane in the middle of the cell: approximate, the paper's
  LKAO_MASKS_MUST_MAY = 1  // rays beyond every plane of the cell, and rays beyond some plane of it: exact answers
};

typedef struct lkao_table_options {
  size_t size;
  int32_t resolution;  // 32 to 256; the table has about resolution^3 cells
  lkao_plane_addressing addressing;
  lkao_plane_masks masks;
  int32_t thread_count;  // that build the table; 0: as many as the process may run at once
} lkao_table_options;
#define LKAO_TABLE_OPTIONS_INIT \
  { sizeof(lkao_table_options), 128, LKAO_ADDRESSING_SLICES, LKAO_MASKS_MUST_MAY, 0 }

typedef struct lkao_table_report {
  size_t size;
  uint32_t cell_count;
  size_t memory_bytes;
  double build_seconds;
} lkao_table_report;
#define LKAO_TABLE_REPORT_INIT \
  { sizeof(lkao_table_report), 0, 0, 0.0 }

// `options` NULL: the defaults.
LKAO_C_API lkao_status lkao_table_create(const lkao_pattern* pattern, const lkao_table_options* options,
                                         lkao_table** table);
// The same table for rays of full length, which shares its storage.
LKAO_C_API lkao_status lkao_table_create_directions(const lkao_table* table, lkao_table** directions);
LKAO_C_API lkao_status lkao_table_destroy(lkao_table* table);

// Cell of the plane with the unit normal n at the distance d, which is clamped to [0, 1], as a share of the AO radius.
LKAO_C_API lkao_status lkao_table_cell(const lkao_table* table, const float n[3], float d, uint32_t* cell);
// Cell of a plane through the receiver, as edges of triangles need.
LKAO_C_API lkao_status lkao_table_edge_cell(const lkao_table* table, const float n[3], uint32_t* cell);

// Masks of a cell, lkao_pattern_word_count() words each, which live as long as the handle. NULL, with an error, for a
// cell that there is not, or masks that the table does not keep: nearest needs LKAO_MASKS_NEAREST, must and may need
// LKAO_MASKS_MUST_MAY.
LKAO_C_API const uint64_t* lkao_table_nearest(const lkao_table* table, uint32_t cell);
LKAO_C_API const uint64_t* lkao_table_must(const lkao_table* table, uint32_t cell);
LKAO_C_API const uint64_t* lkao_table_may(const lkao_table* table, uint32_t cell);

LKAO_C_API lkao_status lkao_table_get_options(const lkao_table* table, lkao_table_options* options);
LKAO_C_API lkao_status lkao_table_get_report(const lkao_table* table, lkao_table_report* report);
// A new handle of the table's pattern.
LKAO_C_API lkao_status lkao_pattern_create_of_table(const lkao_table* table, lkao_pattern** pattern);

#ifdef __cplusplus
}
#endif
