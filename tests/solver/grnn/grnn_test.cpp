// ctest: labels=grnn
#include "solver/grnn/grnn.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "solver/grnn/grnn_validation.h"

BOOST_AUTO_TEST_SUITE(grnn)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd column(std::initializer_list<double> values) {
  MatrixXd m(static_cast<Index>(values.size()), 1);
  Index i = 0;
  for (const double v : values) m(i++, 0) = v;
  return m;
}

MatrixXd random_matrix(Index rows, Index cols, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, cols, [&](Index, Index) { return uniform(random); });
}

/// Returns the prediction by Eq. 36 and 37 as printed by Varalakshmi and Srinivas (2017), in
/// extended precision.
double prediction_as_printed(const Grnn& g, const Eigen::RowVectorXd& x, Index output) {
  long double above = 0;
  long double below = 0;
  for (Index i = 0; i < g.inputs.rows(); ++i) {
    long double squared = 0;
    for (Index f = 0; f < g.inputs.cols(); ++f) {
      const long double d =
          (static_cast<long double>(x(f)) - static_cast<long double>(g.inputs(i, f))) /
          static_cast<long double>(g.scale(f));
      squared += d * d;
    }
    const auto sigma = static_cast<long double>(g.sigma);
    const long double w = std::exp(-squared / (2 * sigma * sigma));
    above += w * static_cast<long double>(g.outputs(i, output));
    below += w;
  }
  return static_cast<double>(above / below);
}

double rms(const MatrixXd& m) {
  return std::sqrt(m.squaredNorm() / static_cast<double>(m.size()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(predictions_are_those_of_the_printed_formula) {
  const MatrixXd inputs = random_matrix(60, 3, 1), outputs = random_matrix(60, 2, 2);
  const MatrixXd queries = 1.5 * random_matrix(40, 3, 3);
  for (const InputScaling scaling :
       {InputScaling::none, InputScaling::deviation, InputScaling::range}) {
    for (const double sigma : {0.05, 0.3, 1.0, 10.0, 1e6}) {
      const Grnn g = make_grnn(inputs, outputs, sigma, scaling);
      const MatrixXd y = predict(g, queries);
      for (Index k = 0; k < queries.rows(); ++k)
        for (Index j = 0; j < 2; ++j)
          BOOST_TEST(std::abs(y(k, j) - prediction_as_printed(g, queries.row(k), j)) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(samples_at_the_same_distance_have_equal_weights) {
  const Grnn between = make_grnn(column({1, 2, 5}), column({10, 20, 90}), 1e-300);
  BOOST_TEST(predict(between, column({1.5}))(0, 0) == 15.0);
  // The query is within one rounding error of the middle between two samples. Its prediction must
  // not be 0/0, although both weights underflow.
  const double y =
      predict(make_grnn(column({0.1, 0.2}), column({1, 2}), 1e-300), column({0.15}))(0);
  BOOST_TEST((y == 1.0 || y == 2.0 || y == 1.5));
}

BOOST_AUTO_TEST_CASE(scaled_inputs_do_not_depend_on_their_unit) {
  const MatrixXd inputs = random_matrix(40, 2, 11), outputs = random_matrix(40, 2, 12);
  const MatrixXd queries = random_matrix(25, 2, 13);
  const Eigen::Vector2d units(1e-3, 4e5);
  for (const InputScaling scaling : {InputScaling::deviation, InputScaling::range}) {
    const MatrixXd y = predict(make_grnn(inputs, outputs, 0.2, scaling), queries);
    const MatrixXd z = predict(make_grnn(inputs * units.asDiagonal(), outputs, 0.2, scaling),
                               queries * units.asDiagonal());
    BOOST_TEST((y - z).norm() < 1e-12);
  }
  const VectorXd bandwidths = Eigen::Vector2d(0.3, 0.7);
  const MatrixXd y = predict(make_grnn(inputs, outputs, 1, bandwidths), queries);
  const MatrixXd z = predict(make_grnn(inputs * bandwidths.cwiseInverse().asDiagonal(), outputs, 1),
                             queries * bandwidths.cwiseInverse().asDiagonal());
  BOOST_TEST((y - z).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(batch_prediction_equals_single_predictions) {
  const Grnn g = make_grnn(random_matrix(100, 3, 14), random_matrix(100, 2, 15), 0.2);
  const MatrixXd queries = random_matrix(77, 3, 16), batch = predict(g, queries);
  for (Index k = 0; k < queries.rows(); ++k)
    BOOST_TEST((predict(g, queries.row(k)) - batch.row(k)).norm() < 1e-14);
  BOOST_TEST(predict(g, MatrixXd(0, 3)).rows() == 0);
}

BOOST_AUTO_TEST_CASE(folds_are_even_and_in_the_requested_order) {
  const std::vector<Index> interleaved = fold_of_samples(7, {3, FoldOrder::interleaved});
  const std::vector<Index> blocks = fold_of_samples(7, {3, FoldOrder::blocks});
  BOOST_TEST(interleaved == (std::vector<Index>{0, 1, 2, 0, 1, 2, 0}));
  BOOST_TEST(blocks == (std::vector<Index>{0, 0, 0, 1, 1, 2, 2}));
  const std::vector<Index> shuffled = fold_of_samples(1000, {10, FoldOrder::shuffled, 5});
  for (Index f = 0; f < 10; ++f) BOOST_TEST(std::count(shuffled.begin(), shuffled.end(), f) == 100);
  BOOST_TEST(shuffled != fold_of_samples(1000, {10, FoldOrder::interleaved}));
  BOOST_TEST(shuffled == fold_of_samples(1000, {10, FoldOrder::shuffled, 5}));
}

BOOST_AUTO_TEST_CASE(sample_split_has_the_requested_size_and_order) {
  const auto count = [](const std::vector<bool>& part) {
    return std::count(part.begin(), part.end(), true);
  };
  for (const Split split : {Split::first, Split::interleaved, Split::shuffled})
    for (const Index train : {1, 379, 631})
      BOOST_TEST(count(training_mask(631, train, split)) == train);
  const std::vector<bool> first = training_mask(631, 379, Split::first);
  BOOST_TEST(first[378]);
  BOOST_TEST(!first[379]);
  // The interleaved split selects 379 of 631 samples (60 %), spread evenly over all samples. It
  // never omits two successive samples.
  const std::vector<bool> spread = training_mask(631, 379, Split::interleaved);
  for (std::size_t i = 0; i + 1 < spread.size(); ++i) BOOST_TEST((spread[i] || spread[i + 1]));
  BOOST_TEST(
      (training_mask(631, 379, Split::shuffled, 1) == training_mask(631, 379, Split::shuffled, 1)));
  BOOST_TEST(
      (training_mask(631, 379, Split::shuffled, 1) != training_mask(631, 379, Split::shuffled, 2)));
  BOOST_CHECK_THROW((void)training_mask(5, 0, Split::first), ModelError);
  BOOST_CHECK_THROW((void)training_mask(5, 6, Split::first), ModelError);
}

BOOST_AUTO_TEST_CASE(search_beats_nearest_neighbor_and_mean) {
  // For samples of a noisy sine, the best smoothing parameter sigma is between the limits 0
  // (nearest neighbor) and infinity (mean of all samples).
  const Index n = 200;
  MatrixXd x(n, 1);
  MatrixXd y(n, 1);
  const MatrixXd noise = 0.3 * random_matrix(n, 1, 21);
  for (Index i = 0; i < n; ++i) {
    x(i, 0) = 0.05 * static_cast<double>(i);
    y(i, 0) = std::sin(x(i, 0)) + noise(i, 0);
  }
  const Grnn g = make_grnn(x, y, 1);
  const SigmaSearch search = search_sigma(g, default_sigma_grid(g), {});
  BOOST_TEST(search.bracketed);
  BOOST_TEST(search.error <= search.grid_error.minCoeff());
  BOOST_TEST((search.sigma > 0.05 && search.sigma < 1));
  const VectorXd near{{0.97 * search.sigma, 1.03 * search.sigma, 1e-300, 1e300}};
  const VectorXd errors = cross_validation_error(g, near, {});
  for (Index k = 0; k < 4; ++k) BOOST_TEST(errors(k) >= search.error);
  BOOST_TEST(errors(2) > 1.1 * search.error);
  // With sigma = 1e300, the prediction for a sample is the mean of all other samples.
  BOOST_TEST(std::abs(errors(3) - static_cast<double>(n) / (n - 1)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(minimum_at_the_end_of_the_grid_is_not_bracketed) {
  const MatrixXd x = VectorXd::LinSpaced(50, 0, 1);
  const Grnn g = make_grnn(x, x, 1);
  const SigmaSearch search = search_sigma(g, logarithmic_grid(0.5, 5, 7), {});
  BOOST_TEST(!search.bracketed);
  BOOST_TEST(search.sigma == search.grid(0));
}

BOOST_AUTO_TEST_CASE(fold_is_predicted_without_its_samples) {
  const MatrixXd inputs = random_matrix(20, 2, 19);
  const MatrixXd outputs = random_matrix(20, 1, 20);
  const double deviation = rms(outputs.array() - outputs.mean());
  const auto error_without = [&](const std::vector<Index>& fold, double sigma) {
    double sum = 0;
    for (Index f = 0; f <= *std::max_element(fold.begin(), fold.end()); ++f) {
      std::vector<Index> in, out;
      for (Index i = 0; i < 20; ++i)
        (fold[static_cast<std::size_t>(i)] == f ? out : in).push_back(i);
      const Grnn g = make_grnn(inputs(in, Eigen::all), outputs(in, Eigen::all), sigma);
      sum += (predict(g, inputs(out, Eigen::all)) - outputs(out, Eigen::all)).squaredNorm();
    }
    return std::sqrt(sum / 20) / deviation;
  };
  std::vector<Index> each(20);
  std::iota(each.begin(), each.end(), 0);
  for (const double sigma : {1e-300, 0.3, 1e300}) {
    const Grnn g = make_grnn(inputs, outputs, sigma);
    const VectorXd sigmas = VectorXd::Constant(1, sigma);
    BOOST_TEST(cross_validation_error(g, sigmas, {})(0) == error_without(each, sigma),
               tolerance(1e-12));
    for (const FoldOrder order : {FoldOrder::interleaved, FoldOrder::shuffled, FoldOrder::blocks}) {
      const CrossValidation validation{4, order, 3};
      BOOST_TEST(cross_validation_error(g, sigmas, validation)(0) ==
                     error_without(fold_of_samples(20, validation), sigma),
                 tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(invalid_samples_and_options_are_refused) {
  const double nan = std::nan("");
  const MatrixXd one = column({1});
  const auto network = [&](double sigma) { return make_grnn(one, one, sigma); };
  BOOST_CHECK_THROW((void)make_grnn(MatrixXd(0, 1), MatrixXd(0, 1), 1), ModelError);
  BOOST_CHECK_THROW((void)make_grnn(column({1, 2}), one, 1), ModelError);
  BOOST_CHECK_THROW((void)make_grnn(column({nan}), one, 1), ModelError);
  BOOST_CHECK_THROW((void)make_grnn(one, column({nan}), 1), ModelError);
  BOOST_CHECK_THROW((void)make_grnn(column({1e200}), one, 1), ModelError);
  BOOST_CHECK_THROW((void)make_grnn(one, one, 1, VectorXd(VectorXd::Zero(1))), ModelError);
  for (const double sigma : {0.0, nan})
    BOOST_CHECK_THROW((void)predict(network(sigma), one), ModelError);
  BOOST_CHECK_THROW((void)predict(network(1), column({nan})), ModelError);
  BOOST_CHECK_THROW((void)predict(network(1), MatrixXd::Ones(1, 2)), ModelError);
  BOOST_CHECK_THROW((void)cross_validation_error(network(1), VectorXd::Ones(1), {}), ModelError);
  for (const Index folds : {1, 6}) BOOST_CHECK_THROW((void)fold_of_samples(5, {folds}), ModelError);
  BOOST_CHECK_THROW((void)logarithmic_grid(0, 1, 5), ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
