// What a program may add laws and terms to, and which it may not: a key means one thing.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "keys/registration.hpp"
#include "sph/core/registry.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/terms/added_term.hpp"

namespace sph {
namespace {

template <class Function>
std::string refusal(Function function) {
  try {
    function();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}

std::string contact_law_with(const LawKey& key) {
  const std::array keys{key};
  ContactLaw law = *contact_laws().front();
  law.word = "mine";
  law.keys = keys;
  return refusal([&] { register_contact_law(law); });
}

std::string eos_with(const LawKey& key) {
  const std::array keys{key};
  EquationOfState law = *equations_of_state().front();
  law.word = "mine";
  law.keys = keys;
  return refusal([&] { register_equation_of_state(law); });
}

constexpr std::string_view too_late = "mine is registered after a scene has been read";

struct Entry {
  std::string_view word;
};

TEST(Registry, IsFixedOnceItHasBeenLookedAt) {
  const Entry ours{"ours"}, theirs{"theirs"}, again{"ours"}, late{"late"};
  Registry<Entry> all({&ours});
  all.add(theirs);
  EXPECT_THROW(all.add(again), std::logic_error);
  ASSERT_EQ(all.look().size(), 2U);
  EXPECT_EQ(all.look()[1], &theirs);
  EXPECT_THROW(all.add(late), std::logic_error);
}

TEST(Registry, AKeyMeansOneThing) {
  const LawKey linear = contact_laws().front()->keys[0], shear = contact_laws().front()->keys[1];
  EXPECT_EQ(linear.name, "normal_stiffness");
  // A new one, and what is the same in another law: nothing is wrong but that scenes have been read.
  EXPECT_EQ(contact_law_with({.name = "new_key"}), too_late);
  EXPECT_EQ(contact_law_with(linear), too_late);
  EXPECT_EQ(contact_law_with({.name = "normal_stiffness", .dimension = dimension::stiffness}), too_late);
  EXPECT_EQ(contact_law_with(shear), too_late);
  EXPECT_EQ(contact_law_with({.name = "poisson_ratio", .above = -1, .most = 0.5}), too_late);
  // Another unit, other bounds, another default.
  EXPECT_EQ(contact_law_with({.name = "normal_stiffness", .dimension = dimension::length}),
            "contact law \"mine\": its key normal_stiffness (a length (m), positive, required) is one of the "
            "contact "
            "law \"linear\" already (a stiffness (N/m), positive, required): give it another name");
  LawKey other = linear;
  other.most = 7;
  EXPECT_NE(contact_law_with(other).find("above 0 and at most 7"), std::string::npos);
  other = linear;
  other.above = 1;
  EXPECT_NE(contact_law_with(other).find("above 1"), std::string::npos);
  other = linear;
  other.otherwise = [](const LawConstants&) { return 1.0; };
  EXPECT_NE(contact_law_with(other).find("with a default"), std::string::npos);
  other = shear;
  other.otherwise = [](const LawConstants&) { return 1.0; };
  EXPECT_EQ(contact_law_with(other), too_late);  // the same in words
  other.default_text = "1 N/m";
  EXPECT_NE(contact_law_with(other).find("\"linear\" already (a stiffness (N/m), positive, default 2/7"),
            std::string::npos);
  EXPECT_NE(contact_law_with({.name = "poisson_ratio", .above = 0, .most = 0.5}).find("\"hertz\""),
            std::string::npos);
  // Laws of another sort are of other scenes.
  EXPECT_EQ(eos_with(linear).find("equation of state \"mine\": its key normal_stiffness ("), 0U);
  EXPECT_NE(eos_with({.name = "bulk_modulus_derivative", .above = 3, .most = 13}).find("\"birch_murnaghan\""),
            std::string::npos);
}

TEST(Registry, KeysOfTheTablesAreTaken) {
  for (const std::string_view name :
       {"density", "kind", "restitution", "bulk_modulus", "sound_speed", "diameter"}) {
    const std::string why = std::string(name) + " is a key of [[group]] already";
    EXPECT_EQ(contact_law_with({.name = name}).find("contact law \"mine\": its key " + why), 0U) << name;
    EXPECT_EQ(eos_with({.name = name}).find("equation of state \"mine\": its key " + why), 0U) << name;
  }
  EXPECT_NE(contact_law_with({.name = "poisson_ratio", .dimension = dimension::length}).find("[[group]]"),
            std::string::npos);
  AddedTerm term = *added_terms().front();
  for (const std::string_view word : {"shifting", "artificial_viscosity", "surface_tension"}) {
    term.word = word;
    EXPECT_EQ(
        refusal([&] { register_term(term); }).find("term \"" + std::string(word) + "\": its word is a key"),
        0U);
  }
  term.word = "mine";
  EXPECT_EQ(refusal([&] { register_term(term); }), too_late);
}

TEST(Registry, OursAgree) {
  for (const keys::KeyOwner& law : keys::key_owners())
    EXPECT_NO_THROW(keys::refuse_taken_keys(law)) << law.word;
}

}  // namespace
}  // namespace sph
