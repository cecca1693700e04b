#include "harness/readers/model_fields.h"

#include <boost/test/unit_test.hpp>
#include <set>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"

BOOST_AUTO_TEST_SUITE(model_fields)

/// Compares the lists of keys and words in the readers with cases/schema/case.schema.json.
using namespace trammel;
using namespace trammel::harness;

namespace {

using Names = std::set<std::string>;

const Json& schema() {
  static const Json json = read_json(data_root() / "cases/schema/case.schema.json");
  return json;
}

/// Collects the keys of a list of fields.
struct FieldList {
  Names required_keys, keys;

  template <class T>
  void optional(const char* key, const T&) {
    keys.insert(key);
  }
  template <class T>
  void defaulted(const char* key, const T&) {
    keys.insert(key);
  }
  template <class T>
  void required(const char* key, const T&) {
    keys.insert(key);
    required_keys.insert(key);
  }
};

/// @param read_alone  keys that are read but never written, and thus are missing in the field list
template <class T>
void check_field_keys(const std::string& definition, const Names& read_alone = {}) {
  const Json& rule = schema()["definitions"][definition];
  FieldList list;
  T part{};
  visit_fields(list, part);
  BOOST_TEST((rule.value("required", Names()) == list.required_keys), definition);
  Names stated;
  for (const auto& property : rule["properties"].items()) stated.insert(property.key());
  list.keys.insert(read_alone.begin(), read_alone.end());
  BOOST_TEST((stated == list.keys), definition);
}

template <class Enum>
void check_words(const std::string& pointer) {
  Names words(kWords<Enum>.begin(), kWords<Enum>.end());
  words.erase("");
  BOOST_TEST((schema()[JsonPointer("/definitions" + pointer + "/enum")].get<Names>() == words),
             pointer);
}

}  // namespace

BOOST_AUTO_TEST_CASE(fields_read_from_json_equal_the_schema_keys) {
  check_field_keys<solver::Material>("material");
  check_field_keys<solver::Member>("member",
                                   {"end_section", "taper", "arc_center_m", "restrained_motions"});
  check_field_keys<solver::Plate>("plate", {"triangles", "blocks", "element", "divisions"});
  check_field_keys<solver::RigidBody>("rigid_body");
  check_field_keys<solver::PointMass>("point_mass");
  check_field_keys<solver::Spring>("spring");
  check_field_keys<Pin>("pin");
  check_field_keys<solver::large_motion::Slider>("slider");
  check_field_keys<solver::large_motion::LineSpring>("axial_spring");
  check_field_keys<solver::NodalLoad>("load", {"edge", "traction_Pa", "normal_Pa"});
}

BOOST_AUTO_TEST_CASE(enumerator_names_equal_the_schema_words) {
  check_words<solver::BeamTheory>("/beam");
  check_words<solver::MassMatrix>("/mass_matrix");
  check_words<Axial>("/axial");
  check_words<NodeMotion>("/motions/items");
  check_words<solver::Taper>("/member/properties/taper");
  check_words<solver::EndFixity>("/member/properties/ends/items/anyOf/0");
  check_words<solver::PlatformKind>("/platform/properties/kind");
  check_words<solver::ActiveKind>("/active_joint/anyOf/0");
  check_words<solver::ElbowKind>("/elbow_joint/anyOf/0");
  check_words<solver::PlatformJointKind>("/platform_joint/anyOf/0");
  check_words<solver::SplineEnds>("/trajectory/properties/spline/properties/ends");
  check_words<solver::EigenMethod>("/eigensolver");
}

BOOST_AUTO_TEST_SUITE_END()
