// Every file of the bad-scene corpus must be refused with one line that names the file, the place and the
// problem. The first line of each file, "# expect: text; text", holds what the message must contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "sph/scene/scene.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path corpus = fs::path(PEPERITE_TEST_DIR) / "bad_scenes";
constexpr std::size_t least_files = 300;

std::vector<fs::path> corpus_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& e : fs::directory_iterator(corpus))
    if (e.path().extension() == ".toml") files.push_back(e.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> expected_texts(const fs::path& file) {
  const std::string mark = "# expect: ";
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line.rfind(mark, 0), 0U) << file << " lacks its first line";
  std::vector<std::string> texts;
  std::size_t begin = mark.size();
  while (begin < line.size()) {
    const std::size_t end = std::min(line.find(';', begin), line.size());
    std::string text = line.substr(begin, end - begin);
    text.erase(0, text.find_first_not_of(' '));
    if (!text.empty()) texts.push_back(text);
    begin = end + 1;
  }
  EXPECT_FALSE(texts.empty()) << file << " expects nothing";
  return texts;
}

std::string message_of(const std::string& path, const std::vector<std::string>& overrides = {}) {
  try {
    (void)sph::read_scene(path, overrides);
  } catch (const sph::InputError& e) {
    return e.what();
  }
  return "(accepted)";
}

TEST(BadScenes, CorpusIsLarge) { EXPECT_GE(corpus_files().size(), least_files); }

TEST(BadScenes, EachIsRefusedWithOneClearLine) {
  for (const fs::path& file : corpus_files()) {
    SCOPED_TRACE(file.filename().string());
    const std::string message = message_of(file.string());
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    ASSERT_EQ(message.rfind(file.string() + ":", 0), 0U) << message;
    const std::string rest = message.substr(file.string().size());
    EXPECT_TRUE(std::regex_search(rest, std::regex("^:[1-9][0-9]*:[1-9][0-9]*: .+: .+; .+"))) << message;
    for (const std::string& text : expected_texts(file))
      EXPECT_NE(message.find(text), std::string::npos) << message << "\n  lacks: " << text;
  }
}

TEST(BadScenes, LinesAreThoseOfTheFile) {
  EXPECT_NE(message_of((corpus / "word_kind.toml").string()).find("word_kind.toml:15:8: "),
            std::string::npos);
  EXPECT_NE(message_of((corpus / "key_misspelt_top.toml").string()).find(":3:1: "), std::string::npos);
}

TEST(BadScenes, MissingFileAndDirectory) {
  const std::string absent = (corpus / "no_such_scene.toml").string();
  EXPECT_EQ(message_of(absent), absent + ":1:1: scene: there is no such file; give the path of a TOML scene");
  EXPECT_EQ(message_of(corpus.string()),
            corpus.string() + ":1:1: scene: is a directory; give the path of a TOML scene");
}

}  // namespace
