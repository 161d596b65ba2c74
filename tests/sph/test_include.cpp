// Scenes of several files: what is merged, what replaces what, and where errors are said to be.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sph/scene/scene.hpp"

namespace {

namespace fs = std::filesystem;

const char* const domain = R"([domain]
lower = [0, 0]
upper = [20, 20]
gravity = [0, -9.8]
[kernel]
h_over_dx = 1.5
[start]
spacing = 0.5
[[start.region]]
group = "melt"
[time]
until = 1
)";
const char* const materials = R"([[group]]
name = "wall"
kind = "wall"
[[group]]
name = "melt"
kind = "fluid"
density = 2500
sound_speed = 20
viscosity = 500
temperature = 1000
heat = { specific_heat = 1000, conductivity = 2 }
)";

class Include : public ::testing::Test {
 protected:
  Include() {
    fs::create_directories(dir_ / "parts");
    file("parts/domain.toml", domain);
    file("parts/materials.toml", materials);
  }
  ~Include() override { fs::remove_all(dir_); }

  void file(const std::string& name, const std::string& text) const { std::ofstream(dir_ / name) << text; }
  /// The scene of this text, in the folder above the parts.
  [[nodiscard]] sph::Scene read(const std::string& text, const std::vector<std::string>& set = {}) const {
    file("scene.toml", text);
    return sph::read_scene((dir_ / "scene.toml").string(), set);
  }
  /// ... without the folder.
  [[nodiscard]] std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) const {
    try {
      (void)read(text, set);
    } catch (const sph::InputError& e) {
      std::string message = e.what();
      for (std::size_t at = 0; (at = message.find(dir_.string() + "/")) != std::string::npos;)
        message.erase(at, dir_.string().size() + 1);
      return message;
    }
    return "(accepted)";
  }

  const fs::path dir_ = fs::temp_directory_path() / ("peperite_include_" + std::to_string(getpid()));
};

const std::string both = "include = [\"parts/materials.toml\", \"parts/domain.toml\"]\n";

TEST_F(Include, IsTheSameAsOneFile) {
  sph::Scene parts = read(both);
  sph::Scene one = read(std::string(domain) + materials);
  EXPECT_EQ(sph::to_toml(parts), sph::to_toml(one));
  EXPECT_EQ(sph::to_toml(parts).find("include"), std::string::npos);
  const sph::Scene again = sph::parse_scene(sph::to_toml(parts), "resolved.toml", {});
  EXPECT_EQ(sph::to_toml(again), sph::to_toml(one));
}

TEST_F(Include, TablesAreMergedKeyByKeyAndTheLastCounts) {
  file("parts/steep.toml", "[domain]\ngravity = [3, -9]\nupper = [30, 20]\n");
  const sph::Scene scene = read(
      "include = [\"parts/materials.toml\", \"parts/domain.toml\", \"parts/steep.toml\"]\n"
      "[domain]\nupper = [40, 20]\n[time]\ndt = 1e-3\n",
      {"time.until=2"});
  EXPECT_EQ(scene.domain.gravity[0], 3);
  EXPECT_EQ(scene.domain.upper[0], 40);
  EXPECT_EQ(scene.time.until, 2) << "--set acts last";
  EXPECT_EQ(scene.time.dt, 1e-3);
}

TEST_F(Include, ElementsOfOneNameAreMergedOthersAppended) {
  const sph::Scene scene = read(both + R"([[group]]
name = "spray"
kind = "fluid"
density = 1
sound_speed = 20
temperature = 1000
heat = { specific_heat = 1000 }
[[group]]
name = "melt"
viscosity = 7
heat = { conductivity = 3 }
[[start.region]]
group = "spray"
shape = "box"
lower = [0, 0]
upper = [1, 1]
)");
  ASSERT_EQ(scene.groups.size(), 3U);
  EXPECT_EQ(scene.groups[1].name, "melt");
  EXPECT_EQ(scene.groups[1].density, 2500);
  EXPECT_EQ(scene.groups[1].viscosity, 7);
  EXPECT_EQ(scene.groups[1].heat.material.specific_heat, 1000);
  EXPECT_EQ(scene.groups[1].heat.material.conductivity, 3);
  EXPECT_EQ(scene.groups[2].name, "spray");
  ASSERT_EQ(scene.start.lattice.regions.size(), 2U);
  EXPECT_EQ(scene.start.lattice.regions[1].group, 2);
}

TEST_F(Include, PathsAreRelativeToTheFileTheyAreIn) {
  fs::create_directories(dir_ / "parts" / "deep");
  file("parts/deep/cuts.toml", "[decomposition]\nrecord = \"cuts.txt\"\n");
  file("parts/all.toml", "include = [\"domain.toml\", \"materials.toml\", \"deep/cuts.toml\"]\n");
  EXPECT_EQ(read("include = \"parts/all.toml\"\n").decomposition.record,
            (dir_ / "parts" / "deep" / "cuts.txt").string());
  EXPECT_EQ(read("include = \"parts/all.toml\"\n", {"decomposition.record=other.txt"}).decomposition.record,
            (fs::current_path() / "other.txt").string());
  const std::string elsewhere = (dir_ / "parts" / "all.toml").string();
  EXPECT_EQ(read("include = \"" + elsewhere + "\"\n").groups.size(), 2U) << "absolute";
}

TEST_F(Include, AFileCountsWhereItComesFirst) {
  file("parts/a.toml", "include = \"domain.toml\"\n[domain]\nupper = [30, 30]\n");
  file("parts/b.toml", "include = [\"../parts/domain.toml\", \"materials.toml\"]\n");
  const sph::Scene scene = read("include = [\"parts/a.toml\", \"parts/b.toml\"]\n");
  EXPECT_EQ(scene.start.lattice.regions.size(), 1U);
  EXPECT_EQ(scene.domain.upper[0], 30);
}

TEST_F(Include, ErrorsAreWhereTheyAreWritten) {
  file("parts/wrong.toml", "# a comment\n[kernel]\nh_over_dx = \"1 m\"\n");
  EXPECT_EQ(refusal("include = [\"parts/materials.toml\", \"parts/domain.toml\", \"parts/wrong.toml\"]\n")
                .find("parts/wrong.toml:3:13: kernel.h_over_dx: "),
            0U);
  file("parts/wrong.toml", "\n[kernel]\nh_over = 1\n");
  EXPECT_EQ(refusal(both + "[start]\nspacin = 1\n").find("scene.toml:3:1: start.spacin: unknown key; "), 0U);
  EXPECT_EQ(refusal("include = \"parts/wrong.toml\"\n").find("parts/wrong.toml:3:1: kernel.h_over: "), 0U);
  file("parts/wrong.toml", "\n[kernel\n");
  EXPECT_EQ(refusal("include = \"parts/wrong.toml\"\n").find("parts/wrong.toml:2:8: syntax: "), 0U);
  EXPECT_EQ(refusal(both + "[start]\ninclude = \"a\"\n"),
            "scene.toml:3:1: start.include: unknown key; it belongs above the first table");
  EXPECT_EQ(refusal(std::string(materials) + materials).find("scene.toml:13:8: group.wall.name: "), 0U);
  const std::string twice = "[[group]]\nname = \"melt\"\nviscosity = 7\n";
  EXPECT_NE(refusal(both + twice + twice).find("group.melt.name: "), std::string::npos) << "in one file";
}

TEST_F(Include, WhatCannotBeIncludedIsSaidAtTheInclude) {
  const std::string right = "; give the path of a scene, relative to this file";
  EXPECT_EQ(refusal("# first\ninclude = \"gone.toml\"\n"),
            "scene.toml:2:11: include: \"gone.toml\": there is no such file" + right);
  EXPECT_EQ(refusal("include = [\"parts/domain.toml\", \"parts\"]\n"),
            "scene.toml:1:33: include: \"parts\": is a directory" + right);
  EXPECT_EQ(refusal("include = [\"parts/domain.toml\", 3]\n"),
            "scene.toml:1:33: include: is a whole number; give the path of a scene, or an array of paths");
  EXPECT_EQ(refusal("include = { file = \"a\" }\n"),
            "scene.toml:1:11: include: is a table; give the path of a scene, or an array of paths");
  EXPECT_EQ(refusal("include = \"scene.toml\"\n"),
            "scene.toml:1:11: include: \"scene.toml\": it includes this file, or is it" + right);
  file("parts/a.toml", "include = \"b.toml\"\n");
  file("parts/b.toml", "\ninclude = [\"domain.toml\", \"../parts/a.toml\"]\n");
  EXPECT_EQ(refusal("include = \"parts/a.toml\"\n"),
            "parts/b.toml:2:27: include: \"../parts/a.toml\": it includes this file, or is it" + right);
  EXPECT_EQ(refusal(both, {"include=a.toml"}).find("--set include=a.toml: include: comes too late"), 0U);
}

TEST_F(Include, ATableStaysATable) {
  EXPECT_EQ(
      refusal(both + "kernel = 3\n"),
      "scene.toml:2:10: kernel: is a whole number, but a table at parts/domain.toml:5:1; write both alike");
  EXPECT_EQ(refusal(both + "[group]\nname = \"melt\"\n")
                .find("scene.toml:2:1: group: is a table, but an array at parts/materials.toml:"),
            0U);
}

}  // namespace
