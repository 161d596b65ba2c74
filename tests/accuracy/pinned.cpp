#include "accuracy/pinned.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace measure {
namespace {

/// Of one suite, which a process runs by itself.
class Pins {
 public:
  static Pins& of(const std::string& suite) {
    static std::map<std::string, Pins> all;
    return all.try_emplace(suite, suite).first->second;
  }
  explicit Pins(const std::string& suite) : file_(PEPERITE_PINS "/" + suite + ".json") {
    if (std::ifstream in(file_); in) in >> kept_;
  }
  Pins(const Pins&) = delete;
  Pins& operator=(const Pins&) = delete;
  ~Pins() {
    if (changed_) std::ofstream(file_) << kept_.dump(1) << '\n';
  }

  void check(const std::string& test, const std::string& what, double value) {
    constexpr double share = 0.02;
    const int times = ++times_[test + what];
    nlohmann::ordered_json& of_test = kept_[test];
    const std::string name = times == 1 ? what : what + ", " + std::to_string(times);
    if (std::getenv("PEPERITE_PIN") != nullptr) {
      of_test[name] = value;
      changed_ = true;
    } else if (!of_test.contains(name)) {
      ADD_FAILURE() << what << " = " << value << " is not in " << file_ << " (PEPERITE_PIN=1 writes it)";
    } else {
      const double kept = of_test[name].get<double>();
      EXPECT_NEAR(value, kept, share * std::abs(kept)) << what << " is not what " << file_ << " has";
    }
  }

 private:
  std::string file_;
  nlohmann::ordered_json kept_;
  std::map<std::string, int> times_;
  bool changed_ = false;
};

}  // namespace

double pinned(const char* what, double value) {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  Pins::of(test->test_suite_name()).check(test->name(), what, value);
  return value;
}

}  // namespace measure
