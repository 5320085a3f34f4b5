// A light asked about as occlusion: the share of it that is hidden.
#pragma once

#include "lkao/soft_shadows.h"
#include "method/method.h"
#include "method/stopwatch.h"

namespace lkao::method {

// `query(outputs)` answers as SoftShadows::query does.
template <class Query>
Answered answer_hidden_share(const QueryOutputs& outputs, const Query& query) {
  const Stopwatch watch;
  const QueryReport report = query(ShadowOutputs{.visibility = outputs.occlusion, .mask_words = outputs.mask_words});
  for (float& value : outputs.occlusion) value = 1 - value;
  return {report, watch.seconds()};
}

}  // namespace lkao::method
