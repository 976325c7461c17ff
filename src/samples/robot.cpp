// The robot: closed parts pushed into each other, as CAD and game models are built. It waves. Front is -y, up is z.
#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup::samples {

namespace {

constexpr int kLimbSegments = 16;
constexpr int kJointSegments = 14;

void add_head(TriangleSoup& soup) {
  add_capsule(soup, {0, 0, 1.58}, {0, 0, 1.80}, 0.15, 0.15, kLimbSegments);
  add_rounded_box(soup, {{0, 0, 2.00}}, {0.36, 0.30, 0.27}, 0.12, 11);
  add_rounded_box(soup, {{0, -0.27, 2.02}}, {0.29, 0.06, 0.17}, 0.05, 6);
  for (const double side : {-1.0, 1.0}) {
    add_ball(soup, {side * 0.13, -0.32, 2.05}, 0.075, 20);
    add_disc(soup, {side * 0.32, 0, 2.0}, {side * 0.42, 0, 2.0}, 0.13, 0.03, 20);
  }
  add_rounded_box(soup, {{0, -0.325, 1.92}}, {0.11, 0.03, 0.022}, 0.018, 4);
  add_capsule(soup, {0, 0, 2.20}, {0, 0, 2.48}, 0.045, 0.03, 12);
  add_ball(soup, {0, 0, 2.52}, 0.085, 20);
}

void add_body(TriangleSoup& soup) {
  add_rounded_box(soup, {{0, 0, 1.27}}, {0.46, 0.31, 0.38}, 0.13, 11);
  add_rounded_box(soup, {{0, -0.29, 1.34}}, {0.28, 0.06, 0.18}, 0.05, 6);
  for (const double x : {-0.15, 0.0, 0.15}) add_ball(soup, {x, -0.345, 1.40}, 0.045, 12);
  add_disc(soup, {0, 0, 0.80}, {0, 0, 0.98}, 0.29, 0.06, kLimbSegments);
  add_rounded_box(soup, {{0, 0, 0.80}}, {0.38, 0.26, 0.14}, 0.09, 7);
  add_rounded_box(soup, {{0, 0.33, 1.30}}, {0.27, 0.12, 0.26}, 0.07, 7);
}

/// A palm, three fingers and a thumb; `frame.z` points along the forearm, `frame.x` towards the thumb.
void add_hand(TriangleSoup& soup, const Frame& frame) {
  Frame palm = frame;
  palm.origin = frame.at({0, 0, 0.10});
  add_rounded_box(soup, palm, {0.14, 0.085, 0.13}, 0.06, 5);
  for (const double x : {-0.09, 0.0, 0.09})
    add_capsule(soup, frame.at({x, 0, 0.18}), frame.at({1.35 * x, 0, 0.36}), 0.047, 0.042, 10);
  add_capsule(soup, frame.at({0.10, 0, 0.06}), frame.at({0.22, 0, 0.18}), 0.047, 0.042, 10);
}

void add_arm(TriangleSoup& soup, const Vec3d& shoulder, const Vec3d& elbow, const Vec3d& wrist) {
  add_ball(soup, shoulder, 0.19, kJointSegments);
  add_capsule(soup, shoulder, elbow, 0.13, 0.13, kLimbSegments);
  add_ball(soup, elbow, 0.155, kJointSegments);
  add_capsule(soup, elbow, wrist, 0.13, 0.145, kLimbSegments);
  const Frame cuff = frame_along(wrist, wrist + (wrist - elbow));
  add_disc(soup, cuff.at({0, 0, -0.05}), cuff.at({0, 0, 0.05}), 0.17, 0.03, 20);
  // The palm lies in the plane of the picture, the thumb on the body's side.
  const Vec3d along = cuff.z;
  const Vec3d across = normalized(cross({0, 1, 0}, along)) * (wrist.x > 0 ? -1.0 : 1.0);
  const double towards_body = wrist.x * across.x > 0 ? -1.0 : 1.0;
  add_hand(soup, {cuff.at({0, 0, 0.05}), across * towards_body, cross(along, across * towards_body), along});
}

void add_leg(TriangleSoup& soup, double side) {
  const Vec3d hip{side * 0.23, 0, 0.76}, knee{side * 0.27, -0.02, 0.46}, ankle{side * 0.28, 0, 0.16};
  add_ball(soup, hip, 0.20, kJointSegments);
  add_capsule(soup, hip, knee, 0.165, 0.15, kLimbSegments);
  add_ball(soup, knee, 0.185, kJointSegments);
  add_capsule(soup, knee, ankle, 0.15, 0.17, kLimbSegments);
  add_rounded_box(soup, {{side * 0.29, -0.08, 0.10}}, {0.20, 0.30, 0.11}, 0.08, 7);
}

}  // namespace

TriangleSoup make_robot() {
  TriangleSoup soup;
  add_head(soup);
  add_body(soup);
  add_arm(soup, {0.55, 0, 1.48}, {0.82, -0.03, 1.20}, {0.80, -0.12, 0.88});
  add_arm(soup, {-0.55, 0, 1.48}, {-0.95, 0, 1.46}, {-1.05, -0.06, 1.84});
  add_leg(soup, 1);
  add_leg(soup, -1);
  return soup;
}

}  // namespace tetsoup::samples
