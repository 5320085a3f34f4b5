#include "bench/report/papers.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

// A cell: a number, a text, or null.
using Row = ordered_json;

struct Table {
  const char* title;
  const char* note;
  std::vector<std::string> heading;
  ordered_json rows = ordered_json::array();
};

const ordered_json* find(const ordered_json& subject, std::string_view contestant) {
  for (const ordered_json& result : subject.at("results")) {
    if (result.at("contestant") == contestant) return &result;
  }
  return nullptr;
}

ordered_json milliseconds(const ordered_json& subject, std::string_view contestant) {
  const ordered_json* const result = find(subject, contestant);
  return result == nullptr ? ordered_json() : ordered_json(1000 * result->at("seconds").get<double>());
}

ordered_json error(const ordered_json& subject, std::string_view contestant, const char* key) {
  const ordered_json* const result = find(subject, contestant);
  return result == nullptr ? ordered_json() : result->at("errors").at(key);
}

ordered_json mega_rays(const ordered_json& subject, std::string_view contestant, int ray_count) {
  const ordered_json* const result = find(subject, contestant);
  if (result == nullptr) return {};
  return 1e-6 * subject.at("receivers").get<double>() * ray_count / result->at("seconds").get<double>();
}

ordered_json ratio(const ordered_json& a, const ordered_json& b) {
  if (!a.is_number() || !b.is_number()) return {};
  return a.get<double>() / b.get<double>();
}

std::string name_of(const ordered_json& subject) {
  return fmt::format("{}, {:g}", subject.at("scene").get<std::string>(), subject.at("radius").get<double>());
}

// Where a scene of the paper is asked about at its radius.
struct PaperRates {
  std::string_view subject;
  double raster, bvh, bvh_1024, caster, caster_1024;  // millions of rays a second
};
constexpr PaperRates kLaineKarras1[] = {{"sibenik, 0.75", 1874, 2251, 2498, 323, 323},
                                        {"sibenik, 2.25", 323, 649, 585, 261, 260}};

Table laine_karras_1(const ordered_json& subjects) {
  Table table{
      "Laine & Karras 2010, Table 1: millions of rays a second",
      "Theirs on a GTX 480 against Aila and Laine's ray caster on the same card; ours on the devices above, "
      "against the best of Embree's modes on the same cores. So only ratios compare. Their views are others, "
      "their triangles one-sided.",
      {"scene, radius", "raster 128", "query 128", "query 1024", "Embree 128", "Embree 1024", "query / Embree 128",
       "... 1024", "paper: BVH / caster 128", "... 1024", "raster / Embree 128", "paper: raster / caster 128"}};
  for (const ordered_json& subject : subjects) {
    const ordered_json raster = mega_rays(subject, "raster, nearest", 128);
    const ordered_json query = mega_rays(subject, "query, 128 rays", 128);
    const ordered_json query_1024 = mega_rays(subject, "query, 1024 rays", 1024);
    const ordered_json caster = mega_rays(subject, "Embree's best mode, 128 rays", 128);
    const ordered_json caster_1024 = mega_rays(subject, "Embree's best mode, 1024 rays", 1024);
    ordered_json theirs[3];
    for (const PaperRates& paper : kLaineKarras1) {
      if (paper.subject != name_of(subject)) continue;
      theirs[0] = paper.bvh / paper.caster;
      theirs[1] = paper.bvh_1024 / paper.caster_1024;
      theirs[2] = paper.raster / paper.caster;
    }
    table.rows.push_back({name_of(subject), raster, query, query_1024, caster, caster_1024, ratio(query, caster),
                          ratio(query_1024, caster_1024), theirs[0], theirs[1], ratio(raster, caster), theirs[2]});
  }
  return table;
}

Table laine_karras_2(const ordered_json& subjects) {
  Table table{
      "Laine & Karras 2010, Table 2: what culling fragments saves",
      "Fragments and speed relative to all five tests, one-sided triangles, 128 rays, in pictures as large as there "
      "was time for. The paper's are of several views of Sibenik at 1024 x 768.",
      {"tests", "scene, radius, pixels", "fragments", "speed", "paper: 0.75, fragments", "speed",
       "paper: 2.25, fragments", "speed"}};
  constexpr double kPaper[6][4] = {{7.06, 0.30, 5.79, 0.30}, {3.78, 0.47, 3.90, 0.40}, {3.22, 0.52, 3.11, 0.47},
                                   {2.11, 0.73, 1.95, 0.70}, {2.03, 0.74, 1.92, 0.70}, {1.00, 1.00, 1.00, 1.00}};
  for (const ordered_json& subject : subjects) {
    const ordered_json culls = subject.value("culls", ordered_json());
    if (culls.is_null()) continue;
    const std::string where =
        fmt::format("{}, {} x {}", name_of(subject), culls.at("width").get<int>(), culls.at("height").get<int>());
    std::size_t i = 0;
    for (const ordered_json& cull : culls.at("rows")) {
      const auto& paper = kPaper[i++];
      table.rows.push_back(
          {cull.at("tests"), where, cull.at("fragments"), cull.at("speed"), paper[0], paper[1], paper[2], paper[3]});
    }
  }
  return table;
}

Table laine_karras_5(const ordered_json& subjects) {
  Table table{
      "Laine & Karras 2010, Figure 5: quality",
      "Mean error, and pixels that are exact at 8 bits, against many rays. The paper has pictures, and says "
      "that most pixels of its two methods are exact at 8 bits against 1024 rays, and those of volumes are not.",
      {"scene, radius", "query 1024", "exact", "raster", "exact", "raster with levels", "exact", "volumes, delta 0.6",
       "exact"}};
  for (const ordered_json& subject : subjects) {
    Row row = {name_of(subject)};
    for (const char* contestant :
         {"query, 1024 rays", "raster, nearest", "raster, levels k 3, epsilon x 1", "volumes, delta 0.6"}) {
      row.push_back(error(subject, contestant, "mae"));
      row.push_back(error(subject, contestant, "equal_8bit_share"));
    }
    table.rows.push_back(row);
  }
  return table;
}

Table time_against_radius(const ordered_json& subjects) {
  Table table{
      "Laine & Karras 2010, Figure 6, and Alchemy 2011, Figure 9: milliseconds against the radius",
      "At 128 rays, and Alchemy's default. Both papers have plots without numbers: in the first, time grows with the "
      "radius, the rasterised method's most, the ray caster's least; in the second, nearly linearly up to a "
      "radius from which on all samples miss the cache. What has no time would have taken too long.",
      {"scene, radius", "query", "Embree's best mode", "raster, nearest", "alchemy"}};
  for (const ordered_json& subject : subjects) {
    if (!subject.contains("sweep")) continue;
    for (const ordered_json& step : subject.at("sweep")) {
      Row row = {fmt::format("{}, {:g}", subject.at("scene").get<std::string>(), step.at("radius").get<double>())};
      for (const char* contestant : {"query, 128 rays", "Embree's best mode, 128 rays", "raster, nearest", "alchemy"}) {
        const ordered_json seconds = step.value(contestant, ordered_json());
        row.push_back(seconds.is_null() ? seconds : ordered_json(1000 * seconds.get<double>()));
      }
      table.rows.push_back(row);
    }
  }
  return table;
}

Table laine_karras_7(const ordered_json& subjects) {
  Table table{"Laine & Karras 2010, Figure 7: levels of detail",
              "The rasterised method, 128 rays. The paper's figure shows pictures; its levels were chosen by hand.",
              {"scene, radius", "ms", "ms with levels, k 3", "k 1.5", "RMSE", "with levels, k 3", "k 1.5"}};
  for (const ordered_json& subject : subjects) {
    Row row = {name_of(subject)};
    const char* const contestants[] = {"raster, nearest", "raster, levels k 3, epsilon x 1",
                                       "raster, levels k 1.5, epsilon x 1"};
    for (const char* contestant : contestants) row.push_back(milliseconds(subject, contestant));
    for (const char* contestant : contestants) row.push_back(error(subject, contestant, "rmse"));
    table.rows.push_back(row);
  }
  return table;
}

Table mcguire_9(const ordered_json& subjects) {
  Table table{
      "McGuire 2010, Figures 1 and 9: time and error",
      "Milliseconds, and the perceptual error of Eq. 14 against rays of the method's own falloff. The paper's for its "
      "volumes, of other views at 1280 x 720, are 0.27 to 2.03.",
      {"scene, radius", "query 64, ms", "Eq. 14", "query 1024, ms", "Eq. 14", "volumes 0.6, ms", "Eq. 14", "splat, ms",
       "Eq. 14"}};
  for (const ordered_json& subject : subjects) {
    Row row = {name_of(subject)};
    for (const char* contestant : {"query, 64 rays", "query, 1024 rays", "volumes, delta 0.6", "splat, both halves"}) {
      const ordered_json* const result = find(subject, contestant);
      const char* const errors =
          result != nullptr && result->contains("own_falloff_errors") ? "own_falloff_errors" : "errors";
      row.push_back(milliseconds(subject, contestant));
      row.push_back(result == nullptr ? ordered_json() : result->at(errors).at("log_error"));
    }
    table.rows.push_back(row);
  }
  return table;
}

Table mcguire_10(const ordered_json& subjects) {
  Table table{"McGuire 2010, Figure 10: fill and time",
              "Fragments of volumes a receiver. In the paper's graph the time follows the fill, and not the number of "
              "triangles.",
              {"scene, radius", "triangles", "fragments a receiver", "ms", "ns a fragment"}};
  for (const ordered_json& subject : subjects) {
    const ordered_json* const result = find(subject, "volumes, delta 0.6");
    if (result == nullptr) continue;
    const auto fragments = result->at("keys").at("volumes").at("fragments").get<double>();
    table.rows.push_back({name_of(subject), subject.at("triangles"), fragments / subject.at("receivers").get<double>(),
                          milliseconds(subject, "volumes, delta 0.6"),
                          1e9 * result->at("seconds").get<double>() / fragments});
  }
  return table;
}

Table vao_1(const ordered_json& subjects) {
  Table table{"VAO++ 2017, Table 1: what its optimisations save",
              "Milliseconds without a filter; in brackets there: the share of the time without either. The paper's are "
              "of 1920 x 1080 on a GTX 970, its culling's candidates always 8 samples.",
              {"samples", "scene, radius", "plain", "adaptive", "culled", "both", "adaptive / plain", "paper",
               "culled / plain", "paper", "both / plain", "paper"}};
  constexpr struct {
    int samples;
    double adaptive, culled, both;
  } kPaper[] = {{2, 1.15, 1.35, 1.43},
                {4, 0.99, 1.11, 1.10},
                {8, 0.83, 0.89, 0.78},
                {16, 0.70, 0.76, 0.59},
                {32, 0.61, 0.67, 0.46}};
  for (const ordered_json& subject : subjects) {
    for (const auto& paper : kPaper) {
      const auto of = [&](const char* what) {
        return milliseconds(subject, fmt::format("vao, {} samples, {}", paper.samples, what));
      };
      const ordered_json plain = of("plain"), adaptive = of("adaptive"), culled = of("culled"), both = of("both");
      table.rows.push_back({fmt::format("{}", paper.samples), name_of(subject), plain, adaptive, culled, both,
                            ratio(adaptive, plain), paper.adaptive, ratio(culled, plain), paper.culled,
                            ratio(both, plain), paper.both});
    }
  }
  return table;
}

// Where a paper compares with what cannot be had, its own numbers stand beside a ray caster of the same device.
constexpr const char* kRival = "Embree's best mode, 128 rays";

Table alchemy_1(const ordered_json& subjects) {
  Table table{
      "Alchemy 2011, Table 1: samples and filters that keep the time",
      "Milliseconds of obscurance, and what the filter adds. The paper's are of Sponza at 1280 x 720, of three "
      "machines: "
      "times compare within one only, so shares of the dearest setting of the GTX 580 stand beside. Its filter reads "
      "less a pixel, two passes of packed 8-bit values, where ours weighs by planes too. Last: our time as a share of "
      "that of 128 rays by Embree, which the paper has not; the same device only where OpenGL draws on the CPU.",
      {"samples x bands, filter", "scene, radius", "obscurance, ms", "filter, ms", "share of 4 x 3", "paper: share",
       "paper: card", "paper: obscurance, ms", "paper: filter, ms", "obscurance / Embree 128"}};
  const AlchemyColumn& dearest = kAlchemyColumns[2];
  for (const ordered_json& subject : subjects) {
    const auto of = [&](const AlchemyColumn& column, bool is_filtered) {
      return milliseconds(subject, "alchemy, " + column.name(is_filtered));
    };
    for (const AlchemyColumn& column : kAlchemyColumns) {
      const ordered_json obscurance = of(column, false), both = of(column, true);
      const bool has_both = obscurance.is_number() && both.is_number();
      const bool is_of_card = std::string_view(column.card) == dearest.card;
      table.rows.push_back(
          {fmt::format("{} x {}, {}", column.samples, column.bands, column.filter_width), name_of(subject), obscurance,
           has_both ? ordered_json(both.get<double>() - obscurance.get<double>()) : ordered_json(),
           ratio(obscurance, of(dearest, false)),
           is_of_card ? ordered_json(column.obscurance / dearest.obscurance) : ordered_json(), column.card,
           column.obscurance, column.filter, ratio(obscurance, milliseconds(subject, kRival))});
    }
  }
  return table;
}

Table vao_2(const ordered_json& subjects) {
  Table table{
      "VAO++ 2017, Table 2: quality and time",
      "The fastest of its four kinds, without a filter, and its RMSE from rays. The paper compares with the SSAO of "
      "the "
      "Unity engine, which cannot be run outside of it, and has pictures in place of errors; its ratio is of times at "
      "1920 x 1080. Ours is to 128 rays by Embree: the same device only where OpenGL draws on the CPU.",
      {"samples", "scene, radius", "ms", "RMSE", "share of 16 samples", "paper: share", "VAO / Embree 128", "paper: ms",
       "paper: VAO++ / SSAO"}};
  constexpr struct {
    int samples;
    double milliseconds, ratio;
  } kPaper[] = {{2, 0.65, 0.89}, {4, 0.92, 0.88}, {8, 1.2, 0.84}, {16, 1.59, 0.79}};
  for (const ordered_json& subject : subjects) {
    const auto fastest = [&](int samples) {
      std::pair<ordered_json, ordered_json> best;  // milliseconds and error
      for (const char* what : {"plain", "adaptive", "culled", "both"}) {
        const std::string name = fmt::format("vao, {} samples, {}", samples, what);
        const ordered_json own = milliseconds(subject, name);
        const bool is_better = own.is_number() && (best.first.is_null() || own < best.first);
        if (is_better) best = {own, error(subject, name, "rmse")};
      }
      return best;
    };
    const ordered_json of_16 = fastest(16).first;
    for (const auto& paper : kPaper) {
      const auto [own, rmse] = fastest(paper.samples);
      table.rows.push_back({fmt::format("{}", paper.samples), name_of(subject), own, rmse, ratio(own, of_16),
                            paper.milliseconds / kPaper[3].milliseconds, ratio(own, milliseconds(subject, kRival)),
                            paper.milliseconds, paper.ratio});
    }
  }
  return table;
}

}  // namespace

ordered_json paper_tables(const ordered_json& subjects) {
  ordered_json all = ordered_json::array();
  for (auto* make : {laine_karras_1, laine_karras_2, laine_karras_5, time_against_radius, laine_karras_7, mcguire_9,
                     mcguire_10, alchemy_1, vao_1, vao_2}) {
    Table table = make(subjects);
    // The paper's numbers alone are no row.
    ordered_json rows = ordered_json::array();
    for (ordered_json& row : table.rows) {
      if (row.size() > 2 && (row[2].is_number() || row[1].is_number())) rows.push_back(std::move(row));
    }
    if (rows.empty()) continue;
    all.push_back(
        {{"title", table.title}, {"note", table.note}, {"heading", table.heading}, {"rows", std::move(rows)}});
  }
  return all;
}

bool is_swept(const Contestant& contestant) {
  for (const char* name : {"query, 128 rays", "Embree's best mode, 128 rays", "raster, nearest", "alchemy"}) {
    if (contestant.name == name) return true;
  }
  return false;
}

}  // namespace lkao::bench
