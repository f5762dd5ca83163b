// Open trees of bodies on revolute joints by Pinocchio's articulated-body algorithm, compiled for this processor:
// one acceleration, and Runge-Kutta's method of order 4 around it.
#include <ctime>
#include <string>
#include <vector>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>

namespace pin = pinocchio;
using Vector = Eigen::VectorXd;
using Point = Eigen::Vector3d;

struct Tree {
  pin::Model model;
  pin::Data data;
  Vector torque;
};

static double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

// A revolute joint; about an axis of the frame it is the cheaper one made for that.
static pin::JointModel revolute(const Point &axis) {
  if (axis.isApprox(Point::UnitX())) return pin::JointModelRX();
  if (axis.isApprox(Point::UnitY())) return pin::JointModelRY();
  if (axis.isApprox(Point::UnitZ())) return pin::JointModelRZ();
  return pin::JointModelRevoluteUnaligned(axis);
}

extern "C" {

// Links in order: parents (-1 is the ground), and of each nineteen numbers: the joint from that of the parent, its axis, the mass, the
// centre of mass from the joint, the inertia about it by rows.
Tree *make(int count, const int *parents, const double *links, const double *gravity) {
  auto *tree = new Tree;
  tree->model.gravity.linear(Eigen::Map<const Point>(gravity));
  for (int i = 0; i < count; i++) {
    const double *link = links + 19 * i;
    Point from(link), axis(link + 3), centre(link + 7);
    Eigen::Matrix3d inertia(Eigen::Map<const Eigen::Matrix3d>(link + 10));
    auto joint = tree->model.addJoint(parents[i] + 1, revolute(axis), pin::SE3(Eigen::Matrix3d::Identity(), from),
                                      "joint" + std::to_string(i));
    tree->model.appendBodyToJoint(joint, pin::Inertia(link[6], centre, inertia), pin::SE3::Identity());
  }
  tree->data = pin::Data(tree->model);
  tree->torque = Vector::Zero(count);
  return tree;
}

void drop(Tree *tree) { delete tree; }

// CPU time of one acceleration, s; the acceleration itself stays in `a`.
double accelerate(Tree *tree, const double *angles, const double *rates, double *a, long calls) {
  int n = tree->model.nv;
  Vector q = Eigen::Map<const Vector>(angles, n), v = Eigen::Map<const Vector>(rates, n);
  double begun = now();
  for (long k = 0; k < calls; k++) {
    pin::aba(tree->model, tree->data, q, v, tree->torque, pin::Convention::LOCAL);
    asm volatile("" : : "r"(tree->data.ddq.data()) : "memory");
  }
  double time = (now() - begun) / calls;
  Eigen::Map<Vector>(a, n) = tree->data.ddq;
  return time;
}

// Marches from rest and returns CPU time, s; `path` gets a point of the last link after every so many steps.
double march(Tree *tree, double h, long steps, long every, const double *point, double *path) {
  int n = tree->model.nv;
  Vector q = Vector::Zero(n), v = Vector::Zero(n), x(n), w(n), a1(n), a2(n), a3(n), a4(n), v2(n), v3(n);
  Point at(point);
  auto force = [&](const Vector &q, const Vector &v) -> const Vector & {
    return pin::aba(tree->model, tree->data, q, v, tree->torque, pin::Convention::LOCAL);
  };
  double time = 0.0, begun = now();
  for (long k = 1; k <= steps; k++) {
    a1 = force(q, v);
    v2 = v + 0.5 * h * a1;
    x = q + 0.5 * h * v;
    a2 = force(x, v2);
    v3 = v + 0.5 * h * a2;
    x = q + 0.5 * h * v2;
    a3 = force(x, v3);
    w = v + h * a3;
    x = q + h * v3;
    a4 = force(x, w);
    q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + w);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    if (k % every == 0) {
      time += now() - begun;
      pin::forwardKinematics(tree->model, tree->data, q);
      Eigen::Map<Point>(path + 3 * (k / every - 1)) = tree->data.oMi[n].act(at);
      begun = now();
    }
  }
  return time + now() - begun;
}
}
