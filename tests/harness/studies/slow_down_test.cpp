#include "harness/studies/slow_down.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(slow_down)

using namespace trammel::harness;

namespace {

/// Processor times of one computation started again and again on a machine shared by several
/// people, in thousandths of their median, in their order: the noise is recorded, all else here is
/// made up.
constexpr int kRecorded[] = {
    1074, 1104, 1067, 1082, 1131, 1122, 1066, 971,  1126, 1099, 1073, 1032, 1067, 1064, 1056, 1041,
    1023, 1001, 940,  810,  873,  968,  863,  952,  850,  826,  967,  952,  971,  944,  969,  937,
    946,  942,  1030, 961,  924,  918,  955,  935,  978,  914,  987,  965,  996,  1017, 982,  966,
    968,  935,  1004, 989,  990,  939,  954,  958,  923,  940,  914,  901,  919,  969,  1034, 980,
    1029, 1021, 994,  886,  919,  956,  979,  963,  994,  1032, 1032, 1029, 1062, 1075, 1011, 1033,
    1026, 1044, 1039, 997,  993,  1019, 1023, 1028, 1031, 1005, 1008, 1006, 998,  1018, 990,  972,
    1026, 985,  1023, 1105, 1137, 1041, 983,  1011, 1012, 1011, 1008, 993,  848,  862,  972,  736,
    752,  884,  902,  833,  846,  976,  881,  994,  894,  964,  1014, 1044, 1025, 1039, 1011, 1034,
    999,  1006, 1041, 1027, 1021, 1072, 1056, 1063, 1006, 1038, 926,  937,  1002, 1010, 1011, 922,
    859,  945,  1102, 1092, 1119, 1003, 927,  886,  926,  871,  955,  969,  1040, 943,  1061, 1054,
    1052, 1233, 1039, 1057, 976,  1038, 1025, 1051, 929,  999,  1030, 981,  987,  986,  939,  1024,
    1007, 1023, 955,  869,  989,  1071, 1039, 1057, 975,  974,  1027, 1001, 1029, 935,  1004, 1021,
    933,  962,  982,  980,  993,  1005, 952,  935,  1038, 1150, 984,  1022, 981,  1099, 1071, 1044,
    1019, 1029, 1058, 1194, 1059, 1014, 1013, 981,  986,  1004, 1031, 977,  991,  1040, 1087, 1038,
    985,  1022, 926,  1047, 905,  1036, 1165, 1152, 991,  924,  844,  1191, 815,  952,  1154, 895};

/// Both programs of a pair take what one of them took at neighbouring times.
std::vector<InterleavedTimes> trial(std::mt19937_64& random, std::size_t cases, std::size_t repeats,
                                    double slow_down) {
  std::vector<InterleavedTimes> times(cases);
  for (std::size_t i = 0; i < cases; ++i) {
    times[i].name = std::to_string(i);
    for (std::size_t k = 0; k < repeats; ++k) {
      const std::size_t at = random() % (std::size(kRecorded) - 1), swap = random() % 2;
      times[i].before_s.push_back(kRecorded[at + swap]);
      times[i].after_s.push_back(kRecorded[at + 1 - swap] * (i == 0 ? 1 + slow_down : 1));
    }
  }
  return times;
}

struct Alarms {
  int seen = 0, false_ones = 0;  ///< trials in which the slow one is told, in which any other is
};

Alarms count_alarms(int trials, double slow_down) {
  constexpr std::size_t kCases = 8, kRepeats = 121;
  std::mt19937_64 random(18);
  Alarms alarms;
  for (int t = 0; t < trials; ++t) {
    bool seen = false, other = false;
    for (const RelativeSpeed& speed : relative_speeds(trial(random, kCases, kRepeats, slow_down))) {
      const bool slow_one = speed.name == "0" && slow_down > 0;
      seen = seen || (slow_one && speed.slower());
      other = other || speed.faster() || (!slow_one && speed.slower());
    }
    alarms.seen += seen ? 1 : 0;
    alarms.false_ones += other ? 1 : 0;
  }
  return alarms;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_program_against_itself_gives_at_most_4_false_alarms_in_200_trials) {
  BOOST_TEST(count_alarms(200, 0).false_ones <= 4);
}

BOOST_AUTO_TEST_CASE(a_slow_down_of_5_percent_is_seen_in_95_of_100_trials) {
  const Alarms alarms = count_alarms(200, 0.05);
  BOOST_TEST(alarms.seen >= 190);
  BOOST_TEST(alarms.false_ones <= 4);
}

BOOST_AUTO_TEST_CASE(the_interval_is_that_of_signed_ranks) {
  // Of 9 pairs that do not differ the sum of ranks is at most 5 with probability 10/512.
  const std::vector<double> logs = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  InterleavedTimes times{"a", {}, {}};
  for (const double log : logs) {
    times.before_s.push_back(1);
    times.after_s.push_back(std::exp(log));
  }
  const RelativeSpeed speed = relative_speeds({times}, 0.04).front();
  // Averages in order: .1 .15 .2 .2 .25 .25 and, the sixth from below, .25.
  BOOST_TEST(std::log(speed.low) == 0.25, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::log(speed.high) == 0.75, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::log(speed.ratio) == 0.5, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(too_few_repeats_say_nothing) {
  InterleavedTimes times{"a", {1, 1, 1}, {9, 9, 9}};
  BOOST_TEST(!relative_speeds({times}).front().slower());
  const std::size_t fewest = fewest_repeats(1);
  times.before_s.assign(fewest, 1);
  times.after_s.assign(fewest, 9);
  BOOST_TEST(relative_speeds({times}).front().slower());
  times.after_s.pop_back();
  BOOST_TEST(!relative_speeds({times}).front().slower());
}

BOOST_AUTO_TEST_SUITE_END()
