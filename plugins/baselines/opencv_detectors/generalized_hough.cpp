#include "plugins/baselines/opencv_detectors/generalized_hough.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "plugins/baselines/opencv_detectors/pictures.hpp"

namespace cairn::opencv_detectors {
namespace {

// Pairs kept for each of Guil's 360 directions, and memory reserved at once. Rooms of 8 x 6 m have fewer than
// half as many; of a building that has more, the last rows are not seen.
constexpr int kMaxPairs = 2000;

struct EdgePicture {
  cv::Mat edges;
  cv::Mat x;  // gradients, CV_32F
  cv::Mat y;
};

EdgePicture edge_picture(const Gradients& gradients, const HoughConfig& config) {
  EdgePicture picture;
  picture.edges = edges_of(gradients, config.edge_low, config.edge_high);
  gradients.x.convertTo(picture.x, CV_32F);
  gradients.y.convertTo(picture.y, CV_32F);
  return picture;
}

// Guil's pairs are of points whose gradients differ by one fixed angle. The one between 60 and 150 degrees
// that most pairs of the template have: sides of a triangle differ by 120 degrees, those of a square by 90.
double pair_angle_deg(const EdgePicture& picture) {
  constexpr int kFrom = 60;
  constexpr int kTo = 150;
  constexpr int kBin = 10;
  std::vector<double> angles;
  for (int y = 0; y < picture.edges.rows; ++y)
    for (int x = 0; x < picture.edges.cols; ++x)
      if (picture.edges.at<std::uint8_t>(y, x) != 0)
        angles.push_back(std::atan2(picture.y.at<float>(y, x), picture.x.at<float>(y, x)));
  std::array<int, (kTo - kFrom) / kBin + 1> pairs{};
  for (const double a : angles)
    for (const double b : angles) {
      const double between = std::abs(degrees(wrap_angle(a - b)));
      if (between >= kFrom && between <= kTo) ++pairs[static_cast<std::size_t>(std::lround((between - kFrom) / kBin))];
    }
  return kFrom + kBin * static_cast<double>(std::ranges::max_element(pairs) - pairs.begin());
}

// Guil would turn and scale the template itself; but a template of its own for each orientation, as the other
// detectors have, finds more, and so has each size. So one angle and one scale, and as few votes as
// there may be for either.
cv::Ptr<cv::GeneralizedHoughGuil> hough_of(const EdgePicture& shape, const HoughConfig& config) {
  auto hough = cv::createGeneralizedHoughGuil();
  hough->setDp(config.bin_cells);
  hough->setXi(pair_angle_deg(shape));
  hough->setAngleEpsilon(degrees(config.angle_tolerance_rad));
  hough->setMinAngle(0.0);
  hough->setMaxAngle(1.0);
  hough->setAngleStep(1.0);
  hough->setAngleThresh(1);
  hough->setMinScale(1.0);
  hough->setMaxScale(1.01);
  hough->setScaleStep(0.01);
  hough->setScaleThresh(1);
  hough->setPosThresh(1);
  hough->setMaxBufferSize(kMaxPairs);
  hough->setTemplate(shape.edges, shape.x, shape.y);
  return hough;
}

struct Vote {
  Point at{0.0, 0.0};  // pixel
  double votes = 0.0;
};

std::vector<Vote> votes_on(cv::GeneralizedHoughGuil& hough, const EdgePicture& picture) {
  cv::Mat places;
  cv::Mat counts;
  hough.detect(picture.edges, picture.x, picture.y, places, counts);
  std::vector<Vote> votes;
  for (int i = 0; i < places.cols; ++i) {
    const auto place = places.at<cv::Vec4f>(0, i);  // x, y, scale, angle
    votes.push_back({{place[0], place[1]}, static_cast<double>(counts.at<cv::Vec3i>(0, i)[0])});
  }
  return votes;
}

}  // namespace

struct GeneralizedHough::Voting {
  cv::Ptr<cv::GeneralizedHoughGuil> hough;
  double max_votes = 0.0;
};

GeneralizedHough::GeneralizedHough(const HoughConfig& config, std::shared_ptr<const TemplateSet> templates)
    : SearchingDetector("generalized_hough", std::move(templates), config.tau_match), config_(config) {
  for (const LandmarkTemplate& shape : set().templates) {
    // Room about it for votes that go astray.
    const EdgePicture picture = edge_picture(gradients_of(shape, 2 * reach()), config);
    Voting& voting = votings_.emplace_back();
    voting.hough = hough_of(picture, config);
    for (const Vote& vote : votes_on(*voting.hough, picture)) voting.max_votes = std::max(voting.max_votes, vote.votes);
    if (voting.max_votes <= 0.0)
      throw std::invalid_argument("a template of category \"" + shape.category + "\" gets no votes on its own picture");
  }
}

GeneralizedHough::~GeneralizedHough() = default;

std::optional<std::vector<Candidate>> GeneralizedHough::search(const OccupancyGrid& grid, const CellBox& centres,
                                                               const Budget& budget) {
  const CellBox box = centres.grown(reach());
  const EdgePicture picture = edge_picture(gradients_of(grid, box), config_);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < votings_.size(); ++i) {
    if (budget.exhausted()) return std::nullopt;
    for (const Vote& vote : votes_on(*votings_[i].hough, picture)) {
      const double degree = std::min(1.0, vote.votes / votings_[i].max_votes);
      const Point at_m = grid.centre_of(box.min) + set().cell_m * vote.at;
      if (degree <= tau_match() || !centres.contains(grid.cell_at(at_m))) continue;
      candidates.push_back({at_m, i, set().templates[i].orientation_rad, degree});
    }
  }
  return candidates;
}

}  // namespace cairn::opencv_detectors
