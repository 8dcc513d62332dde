#include "app/workstation/calibrate/fit/information.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dottrack::calibrate {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Where the free numbers of each camera are among all.
struct Layout {
  std::vector<std::array<int, kNumbers>> column;  // -1: not free
  Index size = 0;

  explicit Layout(const Adjustment& adjustment) {
    for (const AdjustedCamera& c : adjustment.cameras) {
      auto& columns = column.emplace_back();
      for (int i = 0; i < kNumbers; ++i) {
        columns[static_cast<std::size_t>(i)] =
            is_free(c.camera.kind, i) ? static_cast<int>(size++) : -1;
      }
    }
  }
};

// A view's derivatives in units of its sigma, those by the free numbers alone.
struct WeighedView {
  bool known = false;
  Vector2d residual;
  Eigen::Matrix<double, 2, kNumbers> by_numbers;
  Eigen::Matrix<double, 2, 3> by_point;
};

class Elimination {
 public:
  explicit Elimination(const Adjustment& adjustment) : a_(adjustment), layout_(adjustment) {
    weigh();
    gather();
  }

  std::optional<Information> solve() {
    const Eigen::VectorXd scale = reduced_.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * reduced_ * scale.asDiagonal();
    const Eigen::LLT<MatrixXd> factor(scaled);
    if (factor.info() != Eigen::Success) return std::nullopt;
    inverse_ = scale.asDiagonal() * factor.solve(MatrixXd::Identity(layout_.size, layout_.size)) *
               scale.asDiagonal();
    if (!inverse_.allFinite()) return std::nullopt;
    Information information;
    for (std::size_t i = 0; i < a_.cameras.size(); ++i) information.cameras.push_back(block(i, i));
    information.together = together();
    information.off_lens.assign(a_.cameras.size(), Vector2d::Zero());
    for (int term = 0; term < kRadialTerms; ++term) judge_lens(term, information);
    information.views.resize(a_.views.size());
    for (std::size_t j = 0; j < a_.dots.size(); ++j) judge_dot(j, information);
    return information;
  }

 private:
  using Square = Eigen::Matrix<double, kNumbers, kNumbers>;
  using Mixed = Eigen::Matrix<double, kNumbers, 3>;

  void weigh() {
    views_of_.resize(a_.dots.size());
    for (std::size_t i = 0; i < a_.views.size(); ++i) {
      const View& view = a_.views[i];
      WeighedView& w = weighed_.emplace_back();
      views_of_[view.dot].push_back(i);
      const NumberedCamera& camera = a_.cameras[view.camera].camera;
      const auto linear = linear_view(camera, a_.dots[view.dot].position_m());
      if (!linear) continue;
      const double sigma_px = a_.sigma_px(view);
      w.known = true;
      w.residual = (linear->pixel - view.pixel) / sigma_px;
      w.by_numbers = linear->by_numbers / sigma_px;
      for (int k = 0; k < kNumbers; ++k) {
        if (!is_free(camera.kind, k)) w.by_numbers.col(k).setZero();
      }
      w.by_point = linear->by_point / sigma_px;
    }
  }

  Vector3d survey_weight(const AdjustedDot& dot) const {
    if (!dot.trusted) return Vector3d::Zero();
    return (a_.survey_scale * dot.sigma_m).array().square().inverse().matrix();
  }

  void add(std::size_t row, std::size_t column, const Square& block) {
    for (int i = 0; i < kNumbers; ++i) {
      const int r = layout_.column[row][static_cast<std::size_t>(i)];
      if (r < 0) continue;
      for (int j = 0; j < kNumbers; ++j) {
        const int c = layout_.column[column][static_cast<std::size_t>(j)];
        if (c >= 0) reduced_(r, c) += block(i, j);
      }
    }
  }

  // The cameras' block of the inverse.
  Square block(std::size_t row, std::size_t column) const {
    Square out = Square::Zero();
    for (int i = 0; i < kNumbers; ++i) {
      const int r = layout_.column[row][static_cast<std::size_t>(i)];
      if (r < 0) continue;
      for (int j = 0; j < kNumbers; ++j) {
        const int c = layout_.column[column][static_cast<std::size_t>(j)];
        if (c >= 0) out(i, j) = inverse_(r, c);
      }
    }
    return out;
  }

  MatrixXd together() const {
    const std::size_t count = a_.cameras.size();
    MatrixXd out(static_cast<Index>(count) * kNumbers, static_cast<Index>(count) * kNumbers);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        out.block<kNumbers, kNumbers>(static_cast<Index>(i) * kNumbers,
                                      static_cast<Index>(j) * kNumbers) = block(i, j);
      }
    }
    return out;
  }

  void gather() {
    reduced_ = MatrixXd::Zero(layout_.size, layout_.size);
    for (std::size_t i = 0; i < a_.cameras.size(); ++i) {
      Square prior = Square::Zero();
      for (int k = 0; k < kNumbers; ++k) {
        const double sigma = a_.cameras[i].priors.sigma[static_cast<std::size_t>(k)];
        if (sigma > 0.0) prior(k, k) = 1.0 / (sigma * sigma);
      }
      add(i, i, prior);
    }
    for (int term = 0; term < kRadialTerms; ++term) couple(term);
    dot_inverse_.resize(a_.dots.size());
    for (std::size_t j = 0; j < a_.dots.size(); ++j) eliminate(j);
  }

  // A radial term of the cameras whose lenses are alike. The common lens's own, given theirs, is
  // normal with the weighted mean and the variance 1 / weight.
  struct Alike {
    std::vector<std::pair<std::size_t, int>> members;  // camera, column
    Eigen::VectorXd weights;
    double weight = 0.0;
  };

  Alike alike(int term) const {
    Alike out;
    std::vector<double> weights;
    const std::size_t number = static_cast<std::size_t>(kRadial) + static_cast<std::size_t>(term);
    for (std::size_t i = 0; i < a_.cameras.size(); ++i) {
      if (!a_.shares(a_.cameras[i], kRadial + term)) continue;
      out.members.emplace_back(i, layout_.column[i][number]);
      weights.push_back(std::pow(a_.cameras[i].priors.sigma[number], -2));
    }
    out.weights = Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Index>(weights.size()));
    const double sigma = lens_sigma(a_)[static_cast<std::size_t>(term)];
    out.weight = out.weights.sum() + std::pow(sigma, -2);
    return out;
  }

  // That the common lens is not known.
  void couple(int term) {
    if (!a_.lens.exists) return;
    const Alike all = alike(term);
    for (std::size_t i = 0; i < all.members.size(); ++i) {
      for (std::size_t j = 0; j < all.members.size(); ++j) {
        reduced_(all.members[i].second, all.members[j].second) -=
            all.weights[static_cast<Index>(i)] * all.weights[static_cast<Index>(j)] / all.weight;
      }
    }
  }

  void judge_lens(int term, Information& out) const {
    if (!a_.lens.exists) return;
    const Alike all = alike(term);
    const auto size = static_cast<Index>(all.members.size());
    MatrixXd covariance(size, size);
    for (Index i = 0; i < size; ++i) {
      for (Index j = 0; j < size; ++j) {
        covariance(i, j) = inverse_(all.members[static_cast<std::size_t>(i)].second,
                                    all.members[static_cast<std::size_t>(j)].second);
      }
    }
    const Eigen::VectorXd with_lens = covariance * all.weights / all.weight;
    const double of_lens = all.weights.dot(with_lens) / all.weight + 1.0 / all.weight;
    for (Index i = 0; i < size; ++i) {
      out.off_lens[all.members[static_cast<std::size_t>(i)].first][term] =
          covariance(i, i) - 2.0 * with_lens[i] + of_lens;
    }
  }

  bool used(std::size_t view) const { return a_.views[view].kept && weighed_[view].known; }

  void eliminate(std::size_t j) {
    Matrix3d own = survey_weight(a_.dots[j]).asDiagonal();
    for (const std::size_t i : views_of_[j]) {
      if (!used(i)) continue;
      const WeighedView& w = weighed_[i];
      own += w.by_point.transpose() * w.by_point;
      add(a_.views[i].camera, a_.views[i].camera, w.by_numbers.transpose() * w.by_numbers);
    }
    Eigen::FullPivLU<Matrix3d> lu(own);
    dot_inverse_[j] = lu.isInvertible() ? Matrix3d(lu.inverse()) : Matrix3d(Matrix3d::Zero());
    for (const std::size_t i : views_of_[j]) {
      if (!used(i)) continue;
      const Mixed left = mixed(i) * dot_inverse_[j];
      for (const std::size_t k : views_of_[j]) {
        if (used(k)) add(a_.views[i].camera, a_.views[k].camera, -left * mixed(k).transpose());
      }
    }
  }

  Mixed mixed(std::size_t view) const {
    return weighed_[view].by_numbers.transpose() * weighed_[view].by_point;
  }

  // Covariance of a camera's numbers with a dot's position.
  Mixed shared(std::size_t camera, std::size_t dot) const {
    Mixed out = Mixed::Zero();
    for (const std::size_t i : views_of_[dot]) {
      if (used(i)) out -= block(camera, a_.views[i].camera) * mixed(i) * dot_inverse_[dot];
    }
    return out;
  }

  void judge_dot(std::size_t j, Information& out) const {
    Matrix3d dot = dot_inverse_[j];
    for (const std::size_t i : views_of_[j]) {
      if (used(i)) {
        dot -= dot_inverse_[j] * mixed(i).transpose() * shared(a_.views[i].camera, j);
      }
    }
    out.dots.push_back(0.5 * (dot + dot.transpose()));
    judge_survey(j, out);
    for (const std::size_t i : views_of_[j]) judge_view(i, out);
  }

  void judge_survey(std::size_t j, Information& out) const {
    const AdjustedDot& dot = a_.dots[j];
    Judged<3>& judged = out.surveys.emplace_back();
    const Vector3d sigma = a_.survey_scale * dot.sigma_m;
    judged.residual = dot.offset_m.cwiseQuotient(sigma);
    const Matrix3d scaled =
        sigma.cwiseInverse().asDiagonal() * out.dots[j] * sigma.cwiseInverse().asDiagonal();
    judged.covariance =
        dot.trusted ? Matrix3d(Matrix3d::Identity() - scaled) : Matrix3d::Identity() + scaled;
    judged.known =
        std::any_of(views_of_[j].begin(), views_of_[j].end(), [&](auto i) { return used(i); });
  }

  void judge_view(std::size_t i, Information& out) const {
    const WeighedView& w = weighed_[i];
    if (!w.known) return;
    const View& view = a_.views[i];
    const Mixed with_dot = shared(view.camera, view.dot);
    const Eigen::Matrix2d cross = w.by_numbers * with_dot * w.by_point.transpose();
    const Eigen::Matrix2d predicted =
        w.by_numbers * block(view.camera, view.camera) * w.by_numbers.transpose() + cross +
        cross.transpose() + w.by_point * out.dots[view.dot] * w.by_point.transpose();
    Judged<2>& judged = out.views[i];
    judged.known = true;
    judged.residual = w.residual;
    judged.covariance = view.kept ? Eigen::Matrix2d(Eigen::Matrix2d::Identity() - predicted)
                                  : Eigen::Matrix2d(Eigen::Matrix2d::Identity() + predicted);
  }

  const Adjustment& a_;
  Layout layout_;
  std::vector<WeighedView> weighed_;
  std::vector<std::vector<std::size_t>> views_of_;
  std::vector<Matrix3d> dot_inverse_;
  MatrixXd reduced_;
  MatrixXd inverse_;
};

}  // namespace

std::optional<Information> inform(const Adjustment& adjustment) {
  return Elimination(adjustment).solve();
}

}  // namespace dottrack::calibrate
