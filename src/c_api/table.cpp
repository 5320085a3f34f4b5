#include "lkao/c/table.h"

#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "c_api/handles.h"
#include "c_api/versioned.h"
#include "c_api/words.h"

using namespace lkao::c_api;

namespace {

glm::vec3 unit_vector(const float n[3]) {
  const glm::vec3 normal(needed(n, "n")[0], n[1], n[2]);
  if (!(std::abs(glm::length(normal) - 1) < 1e-3f)) {
    refuse("n must be a unit vector, not of length " + std::to_string(glm::length(normal)));
  }
  return normal;
}

const lkao::PlaneMaskTable& checked(const lkao_table* table, std::uint32_t cell, lkao::PlaneMasks masks) {
  const lkao::PlaneMaskTable& found = object(table, "table");
  if (found.options().masks != masks) {
    refuse(masks == lkao::PlaneMasks::nearest ? "table has no nearest masks: it was made with LKAO_MASKS_MUST_MAY"
                                              : "table has no must and may masks: it was made with LKAO_MASKS_NEAREST");
  }
  if (cell >= found.cell_count()) {
    refuse("cell must be less than " + std::to_string(found.cell_count()) + ", not " + std::to_string(cell));
  }
  return found;
}

constexpr const uint64_t* kNone = nullptr;

}  // namespace

lkao_status lkao_table_create(const lkao_pattern* pattern, const lkao_table_options* options, lkao_table** table) {
  return create(__func__, table, "table", [&] {
    const lkao_table_options from = read_or_defaults(options, LKAO_TABLE_OPTIONS_INIT, "options");
    return lkao::PlaneMaskTable(object(pattern, "pattern"),
                                {.resolution = from.resolution,
                                 .addressing = word(kAddressings, from.addressing, "options->addressing"),
                                 .masks = word(kPlaneMasks, from.masks, "options->masks"),
                                 .thread_count = from.thread_count});
  });
}

lkao_status lkao_table_create_directions(const lkao_table* table, lkao_table** directions) {
  return create(__func__, directions, "directions", [&] { return object(table, "table").directions(); });
}

lkao_status lkao_table_destroy(lkao_table* table) { return destroy(__func__, table, "table"); }

lkao_status lkao_table_cell(const lkao_table* table, const float n[3], float d, uint32_t* cell) {
  return guard(__func__, [&] {
    needed(cell, "cell");
    const glm::vec3 normal = unit_vector(n);
    if (std::isnan(d)) refuse("d must be a number, not nan");
    *cell = object(table, "table").cell(normal, d);
  });
}

lkao_status lkao_table_edge_cell(const lkao_table* table, const float n[3], uint32_t* cell) {
  return guard(__func__, [&] {
    needed(cell, "cell");
    *cell = object(table, "table").edge_cell(unit_vector(n));
  });
}

const uint64_t* lkao_table_nearest(const lkao_table* table, uint32_t cell) {
  return guard_value(__func__, kNone, [&] { return checked(table, cell, lkao::PlaneMasks::nearest).nearest(cell); });
}

const uint64_t* lkao_table_must(const lkao_table* table, uint32_t cell) {
  return guard_value(__func__, kNone, [&] { return checked(table, cell, lkao::PlaneMasks::must_may).must(cell); });
}

const uint64_t* lkao_table_may(const lkao_table* table, uint32_t cell) {
  return guard_value(__func__, kNone, [&] { return checked(table, cell, lkao::PlaneMasks::must_may).may(cell); });
}

lkao_status lkao_table_get_options(const lkao_table* table, lkao_table_options* options) {
  return guard(__func__, [&] {
    check_size(options, "options");
    const lkao::PlaneMaskTableOptions& from = object(table, "table").options();
    lkao_table_options result = LKAO_TABLE_OPTIONS_INIT;
    result.resolution = from.resolution;
    result.addressing = number_of(kAddressings, from.addressing);
    result.masks = number_of(kPlaneMasks, from.masks);
    result.thread_count = from.thread_count;
    write(result, options);
  });
}

lkao_status lkao_table_get_report(const lkao_table* table, lkao_table_report* report) {
  return guard(__func__, [&] {
    check_size(report, "report");
    const lkao::PlaneMaskTable& from = object(table, "table");
    lkao_table_report result = LKAO_TABLE_REPORT_INIT;
    result.cell_count = from.cell_count();
    result.memory_bytes = from.memory_bytes();
    result.build_seconds = from.build_seconds();
    write(result, report);
  });
}

lkao_status lkao_pattern_create_of_table(const lkao_table* table, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern", [&] { return object(table, "table").pattern(); });
}
