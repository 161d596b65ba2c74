#include "keys/time_curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "keys/scene_writer.hpp"

namespace sph {

TimeCurve read_curve(const std::optional<KeyValue>& value, Dimension dim) {
  if (!value) return {};
  const toml_tree::Array* points = value->node().array();
  if (points == nullptr) return {{0, value->number_in(value->node(), dim)}};
  TimeCurve out;
  for (const toml_tree::Node& point : *points) {
    const toml_tree::Array* pair = point.array();
    if (pair == nullptr || pair->size() != 2)
      value->fail("has a point that is no pair", "give [[time, value], ...]");
    out.push_back({value->number_in((*pair)[0], dimension::time), value->number_in((*pair)[1], dim)});
    if (out.size() > 1 && !(out[out.size() - 2][0] < out.back()[0]))
      value->fail(fmt::format("goes from {} s to {} s", out[out.size() - 2][0], out.back()[0]),
                  "times must ascend");
  }
  if (out.empty()) value->fail("is an empty array", "give [[time, value], ...]");
  return out;
}

void write_curve(SceneWriter& out, std::string_view key, const TimeCurve& curve) {
  std::vector<std::string> texts;
  for (const auto& [t, value] : curve)
    texts.push_back(fmt::format("[{}, {}]", SceneWriter::real(t), SceneWriter::real(value)));
  if (!curve.empty()) out.raw(key, fmt::format("[{}]", fmt::join(texts, ", ")));
}

}  // namespace sph
