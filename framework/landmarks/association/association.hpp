// Which landmark is it? By place, pose error and template sets (docs/method.md 8.2).
//
// What a matching shows at one place is of the landmark for which
//
//   log p(place, templates | this landmark) - log p(place, templates | one that is not known yet)
//
// is largest and above 0. The pose error is common to all that was seen lately: the places of the last few detections
// are explained together, so that two landmarks alike are not taken for each other when the pose has shifted.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/landmarks/association/joint_association.hpp"
#include "framework/landmarks/template_sets.hpp"

namespace cairn {

class LandmarkAssociation {
 public:
  struct Known {
    LandmarkRef ref;
    const Landmark* landmark = nullptr;
  };
  struct Answer {
    std::optional<LandmarkRef> landmark;  // none: not known yet
    bool is_sure = true;                  // no other known landmark is about as likely
  };

  LandmarkAssociation(const LandmarksConfig& config, const std::vector<LandmarkShape>& shapes);

  // The pose with its covariance, at every tick: what the pose error may have grown by.
  void record_pose(const PoseEstimate& pose);
  // For each part of one matching, no landmark twice. O(known), then O(4^6) for the last places.
  [[nodiscard]] std::vector<Answer> associate(const std::vector<Matching>& parts, std::span<const Known> known);
  // Log-likelihood ratio of two known landmarks: one, or two.
  [[nodiscard]] double log_ratio(const Known& a, const Known& b) const;

  // The landmark has been found, or placed anew, where the last matching has seen it.
  void found(LandmarkRef landmark) { anchors_[landmark] = {now_, now_, {}}; }
  void placed(LandmarkRef landmark);
  void renamed(LandmarkRef from, LandmarkRef to);
  void forget(LandmarkRef landmark);
  // The map has been drawn anew: what was seen lately has no place in it, and no error that was common to it is left.
  void forget_places();
  // Degrees of one matching that are further apart than this are of two landmarks.
  [[nodiscard]] double split_m() const;

 private:
  // Of the pose error: its variance in x and y, and the sum of all that it has ever grown by.
  struct Moment {
    double variance_m2 = 0.0;
    double grown_m2 = 0.0;
  };
  // When a landmark was first seen and when it was placed where it is; how far the pose had shifted in between.
  struct Anchor {
    Moment first;
    Moment last;
    Offset shift;
  };
  // What one landmark is to a place that was seen.
  struct Relation {
    LandmarkRef landmark;
    Anchor anchor;  // as it was then
    Point off_m;    // of the place from the landmark
    double log_agreement = 0.0;
    double apart_m = 0.0;
  };
  struct Sight {
    Point at_m;
    Moment when;
    int matching = 0;
    std::vector<Relation> relations;
  };

  [[nodiscard]] Anchor anchor_of(LandmarkRef landmark) const;
  // From centre to centre, at least, of two landmarks: they are solid.
  [[nodiscard]] double apart_m(const std::string& category, const std::string& other) const;
  [[nodiscard]] double shifted_since(const Moment& moment) const;  // variance of the shift of the pose, m²
  [[nodiscard]] Sight sight_of(const Matching& part, std::span<const Known> known) const;
  void remember(Sight sight);
  [[nodiscard]] double common_shift_m2() const;
  [[nodiscard]] SeenPlace seen_place(const Sight& sight) const;

  LandmarksConfig config_;
  TemplateSets sets_;
  std::map<std::string, double> inner_radius_m_;
  std::map<LandmarkRef, Anchor> anchors_;  // without those of earlier runs
  std::vector<Sight> recent_;              // oldest first
  Moment now_;
  double heading_variance_rad2_ = 0.0;
  int matchings_ = 0;
  double common_m2_ = 0.0;  // of the last association: what the pose has shifted since the older landmarks were seen
  Offset shift_;
};

}  // namespace cairn
