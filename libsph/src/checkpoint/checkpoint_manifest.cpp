#include "checkpoint/checkpoint_manifest.hpp"

#include <bit>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "files/content_hash.hpp"

namespace sph {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "peperite checkpoint 9";

/// The bits are what counts; the value is for readers with eyes.
Json exact(double x) { return {{"bits", to_hex(std::bit_cast<std::uint64_t>(x))}, {"value", x}}; }
double exact(const Json& json) { return std::bit_cast<double>(from_hex(json.at("bits").get<std::string>())); }

/// Appends the hash of `text` as the last member of the JSON object that it holds.
std::string sealed(std::string text) {
  text.resize(text.find_last_of('}'));
  text.resize(text.find_last_not_of(" \n") + 1);
  const std::string hash = to_hex(content_hash(std::as_bytes(std::span(text))));
  return text + ",\n \"hash\": \"" + hash + "\"\n}\n";
}

bool is_sealed(const std::string& text) {
  const std::size_t last = text.rfind(",\n \"hash\": \"");
  return last != std::string::npos && sealed(text.substr(0, last) + "}") == text;
}

Json json_of(const Part& part) {
  Json extents = Json::array();
  for (const Extent& extent : part.extents) extents.push_back({extent.offset, extent.bytes});
  return {{"file", part.file},
          {"bytes", part.bytes},
          {"rows", part.rows},
          {"frame_hash", to_hex(part.frame_hash)},
          {"table_hash", to_hex(part.table_hash)},
          {"extents", extents}};
}

Part part_of(const Json& json) {
  Part part;
  part.file = json.at("file").get<std::string>();
  part.bytes = json.at("bytes").get<std::uint64_t>();
  part.rows = json.at("rows").get<std::uint64_t>();
  part.frame_hash = from_hex(json.at("frame_hash").get<std::string>());
  part.table_hash = from_hex(json.at("table_hash").get<std::string>());
  for (const Json& extent : json.at("extents"))
    part.extents.push_back({extent.at(0).get<std::uint64_t>(), extent.at(1).get<std::uint64_t>()});
  return part;
}

Json json_of(const WallState& wall) {
  Json velocity = Json::array();
  for (double v : wall.velocity) velocity.push_back(exact(v));
  return {{"offset", wall.offset}, {"velocity", velocity}, {"force", wall.force}};
}

WallState wall_of(const Json& json) {
  WallState wall;
  wall.offset = json.at("offset").get<std::array<std::int64_t, 3>>();
  wall.force = json.at("force").get<std::array<std::int64_t, 3>>();
  for (std::size_t a = 0; a < 3; ++a) wall.velocity[a] = exact(json.at("velocity").at(a));
  return wall;
}

/// Its numbers in their order: integers as they are.
Json json_of(const BodyState& body) {
  Json numbers = Json::array();
  for_each_number(body, [&]<class T>(const char*, std::size_t, const T& number) {
    if constexpr (std::is_same_v<T, double>)
      numbers.push_back(exact(number));
    else
      numbers.push_back(number);
  });
  return numbers;
}

BodyState body_of(const Json& json) {
  BodyState body;
  std::size_t at = 0;
  for_each_number(body, [&]<class T>(const char*, std::size_t, T& number) {
    if constexpr (std::is_same_v<T, double>)
      number = exact(json.at(at++));
    else
      number = json.at(at++).get<T>();
  });
  return body;
}

Json json_of(const Passage& passage) {
  Json values = Json::array();
  for (const double x : passage.amounts) values.push_back(exact(x));
  for (const double x : passage.momentum) values.push_back(exact(x));
  values.push_back(exact(passage.kinetic_energy));
  values.push_back(exact(passage.beside));
  return {{"count", passage.count}, {"values", values}};
}

Passage passage_of(const Json& json) {
  Passage passage;
  passage.count = json.at("count").get<std::int64_t>();
  const Json& values = json.at("values");
  std::size_t k = 0;
  for (double& x : passage.amounts) x = exact(values.at(k++));
  for (double& x : passage.momentum) x = exact(values.at(k++));
  passage.kinetic_energy = exact(values.at(k++));
  passage.beside = exact(values.at(k));
  return passage;
}

Field field_named(const std::string& name) {
  for (const FieldInfo& i : field_table)
    if (i.name == name) return i.field;
  throw std::runtime_error("holds a field '" + name + "' that this program does not know");
}

}  // namespace

std::uint64_t Manifest::rows() const {
  std::uint64_t sum = 0;
  for (const Part& part : parts) sum += part.rows;
  return sum;
}

std::string to_text(const Part& part) { return json_of(part).dump() + "\n"; }
Part part_from_text(const std::string& text) { return part_of(Json::parse(text)); }

std::string to_text(const Manifest& m) {
  const GlobalState& g = m.record.global;
  Json fields = Json::array();
  for (Field f : m.fields) fields.push_back(info(f).name);
  Json motion = Json::array();
  for (const double v : g.motion.velocity) motion.push_back(exact(v));
  motion.push_back(exact(g.motion.unlike));
  motion.push_back(exact(g.motion.largest));
  Json walls = Json::array();
  for (const WallState& wall : g.walls) walls.push_back(json_of(wall));
  Json bodies = Json::array();
  for (const BodyState& body : g.bodies) bodies.push_back(json_of(body));
  Json passages = Json::array();
  for (const Passage& passage : g.throughput.passages) passages.push_back(json_of(passage));
  Json inflows = Json::array();
  for (const Inflow& inflow : g.inflows) inflows.push_back({inflow.receivers, exact(inflow.due)});
  Json parts = Json::array();
  for (const Part& part : m.parts) parts.push_back(json_of(part));
  const Json json{{"format", format},
                  {"step", g.step},
                  {"time", exact(g.time)},
                  {"dt", exact(g.dt)},
                  {"max_speed", exact(g.max_speed)},
                  {"max_acceleration", exact(g.max_acceleration)},
                  {"walls", walls},
                  {"bodies", bodies},
                  {"fluid_volume", {g.fluid_volume.start, g.fluid_volume.now}},
                  {"motion", motion},
                  {"flow", {exact(g.flow.interval), g.flow.left, g.flow.iterations, exact(g.flow.residual)}},
                  {"passages", passages},
                  {"id_stride", g.throughput.id_stride},
                  {"inflows", inflows},
                  {"quantum", exact(m.record.scale.quantum)},
                  {"origin", m.record.scale.origin},
                  {"dim", m.dim},
                  {"particles", m.rows()},
                  {"fields", fields},
                  {"history", m.history},
                  {"fingerprint", m.provenance.fingerprint},
                  {"group_names", m.provenance.group_names},
                  {"version", m.version},
                  {"git", m.git},
                  {"compiler", m.compiler},
                  {"flags", m.flags},
                  {"scene", m.record.scene_toml},
                  {"extra", m.record.extra_json},
                  {"parts", parts}};
  return sealed(json.dump(1));
}

Manifest manifest_from_text(const std::string& text) {
  if (text.empty()) throw std::runtime_error("manifest.json is empty");
  if (!is_sealed(text)) throw std::runtime_error("manifest.json is damaged: it does not have its own hash");
  const Json json = Json::parse(text);
  if (json.at("format") != format)
    throw std::runtime_error("is of the format '" + json.at("format").get<std::string>() +
                             "', this program reads '" + format + "'");
  Manifest m;
  m.record.global = {
      json.at("step").get<std::int64_t>(),
      exact(json.at("time")),
      exact(json.at("dt")),
      exact(json.at("max_speed")),
      exact(json.at("max_acceleration")),
      {},
      {json.at("fluid_volume").at(0), json.at("fluid_volume").at(1)},
      {{exact(json.at("motion").at(0)), exact(json.at("motion").at(1)), exact(json.at("motion").at(2))},
       exact(json.at("motion").at(3)),
       exact(json.at("motion").at(4))},
      {exact(json.at("flow").at(0)), json.at("flow").at(1), json.at("flow").at(2),
       exact(json.at("flow").at(3))},
      {},
      {}};
  for (const Json& wall : json.at("walls")) m.record.global.walls.push_back(wall_of(wall));
  for (const Json& body : json.at("bodies")) m.record.global.bodies.push_back(body_of(body));
  for (const Json& passage : json.at("passages"))
    m.record.global.throughput.passages.push_back(passage_of(passage));
  m.record.global.throughput.id_stride = json.at("id_stride").get<std::uint64_t>();
  for (const Json& inflow : json.at("inflows"))
    m.record.global.inflows.push_back({inflow.at(0).get<std::int64_t>(), exact(inflow.at(1))});
  m.record.scale.quantum = exact(json.at("quantum"));
  m.record.scale.origin = json.at("origin").get<std::array<std::int64_t, 3>>();
  m.record.scene_toml = json.at("scene").get<std::string>();
  m.record.extra_json = json.at("extra").get<std::string>();
  m.dim = json.at("dim").get<int>();
  m.history = json.at("history").get<bool>();
  m.provenance = {m.record.scene_toml, json.at("fingerprint").get<std::string>(),
                  json.at("group_names").get<std::vector<std::string>>()};
  m.version = json.at("version").get<std::string>();
  m.git = json.at("git").get<std::string>();
  m.compiler = json.at("compiler").get<std::string>();
  m.flags = json.at("flags").get<std::string>();
  for (const Json& name : json.at("fields")) m.fields.push_back(field_named(name.get<std::string>()));
  for (const Json& part : json.at("parts")) m.parts.push_back(part_of(part));
  return m;
}

}  // namespace sph
