// The C interface: calls in any order, with handles that may be NULL, numbers of any size and texts of any kind. Never
// an internal error, never a crash.
#include <array>

#include "fuzz.h"
#include "tetsoup/tetsoup_c.h"

namespace tetsoup::fuzz {
namespace {

void check(tetsoup_status status) {
  if (status == TETSOUP_INTERNAL_ERROR) std::fprintf(stderr, "%s\n", tetsoup_last_error());
  expect(status != TETSOUP_INTERNAL_ERROR, "no internal error");
}

/// Small ones mostly.
double number(Choices& choices) {
  return choices.below(8) == 0 ? choices.take<double>() : choices.between(-2, 2);
}
std::size_t index(Choices& choices) {
  return choices.below(16) == 0 ? choices.take<std::size_t>() : choices.below(12);
}
int cancel_at(const char*, double, void* left) {
  return --*static_cast<int*>(left) < 0 ? 1 : 0;
}

class Caller {
 public:
  explicit Caller(Bytes bytes) : choices_(bytes) {}
  ~Caller() {
    tetsoup_simulation_destroy(simulation_);
    tetsoup_model_destroy(model_);
    tetsoup_pipeline_destroy(pipeline_);
    tetsoup_soup_destroy(soup_);
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  void run() {
    constexpr int kMostCalls = 24;
    for (int i = 0; i < kMostCalls && choices_.are_left(); ++i) call();
  }

 private:
  void call() {
    switch (choices_.below(6)) {
      case 0:
        return make_soup();
      case 1:
        return use_pipeline();
      case 2:
        return use_model();
      case 3:
        return make_simulation();
      case 4:
        return use_simulation();
      default:
        return look();
    }
  }

  /// NULL now and then.
  template <class T>
  T* maybe(T* pointer) {
    return choices_.below(32) == 0 ? nullptr : pointer;
  }
  const char* text() {
    text_ = choices_.text();
    return maybe(text_.c_str());
  }
  const char* options() {
    constexpr std::array<const char*, 4> kOptions{R"({"voxels": 10, "cells": 4})", R"({"voxels": 12, "tets": 60})",
                                                  R"({"voxels": 8, "vertices": 30})",
                                                  R"({"voxels": 9, "cells": 3, "passes": 0})"};
    return kOptions[choices_.below(kOptions.size())];
  }
  tetsoup_progress progress() { return choices_.below(8) == 0 ? cancel_at : nullptr; }
  void* left() {
    left_ = static_cast<int>(choices_.below(8));
    return &left_;
  }

  void make_soup() {
    tetsoup_soup* soup = nullptr;
    if (choices_.below(4) == 0) {
      const std::string_view bytes = choices_.text();
      check(tetsoup_soup_parse(maybe(bytes.data()), bytes.size(), text(), maybe(&soup)));
    } else {
      constexpr std::size_t kVertices = 8;
      std::array<float, 3 * kVertices> vertices;
      for (float& x : vertices) x = static_cast<float>(number(choices_));
      std::array<std::uint32_t, 36> triangles;
      for (std::uint32_t& corner : triangles) corner = static_cast<std::uint32_t>(index(choices_));
      check(tetsoup_soup_create(maybe(vertices.data()), kVertices, maybe(triangles.data()), 12, maybe(&soup)));
    }
    if (soup == nullptr) return;
    tetsoup_soup_destroy(soup_);
    soup_ = soup;
  }

  void use_pipeline() {
    if (pipeline_ == nullptr || choices_.below(4) == 0) {
      tetsoup_pipeline* pipeline = nullptr;
      check(tetsoup_pipeline_create(maybe(soup_), progress(), left(), maybe(&pipeline)));
      if (pipeline == nullptr) return;
      tetsoup_pipeline_destroy(pipeline_);
      pipeline_ = pipeline;
    }
    // No text of the input's: it could ask for a grid that takes minutes.
    check(tetsoup_pipeline_run_until(maybe(pipeline_), static_cast<tetsoup_stage>(choices_.below(6)), options(),
                                     progress(), left()));
  }

  void use_model() {
    if (model_ == nullptr || choices_.below(4) == 0) {
      tetsoup_model* model = nullptr;
      check(tetsoup_model_create(maybe(pipeline_), text(), progress(), left(), maybe(&model)));
      if (model == nullptr) return;
      tetsoup_model_destroy(model_);
      model_ = model;
    }
    const std::array<double, 3> low{number(choices_), number(choices_), number(choices_)},
        high{number(choices_), number(choices_), number(choices_)};
    std::size_t count = 0;
    check(tetsoup_model_add_pins(model_, text(), low.data(), maybe(high.data()), maybe(&count)));
    check(tetsoup_model_set_material(model_, number(choices_), number(choices_), number(choices_), number(choices_)));
    check(tetsoup_model_set_up(model_, static_cast<std::int32_t>(index(choices_))));
    tetsoup_floats floats{}, normals{};
    check(tetsoup_model_vertices(model_, maybe(&floats)));
    if (floats.data != nullptr)
      check(tetsoup_model_deform(model_, maybe(floats.data), choices_.below(4) == 0 ? index(choices_) : floats.count,
                                 maybe(&floats), maybe(&normals)));
    const char* json = nullptr;
    check(tetsoup_model_report(model_, maybe(&json)));
  }

  void make_simulation() {
    tetsoup_simulation* simulation = nullptr;
    check(tetsoup_simulation_create(choices_.below(4) == 0 ? text() : R"({"substeps": 2, "max_substeps": 2})",
                                    maybe(&simulation)));
    if (simulation == nullptr) return;
    tetsoup_simulation_destroy(simulation_);
    simulation_ = simulation;
    stepped_ = false;
  }

  void add_body() {
    std::size_t body = 0;
    if (choices_.below(2) == 0) {
      check(tetsoup_simulation_add_model(simulation_, maybe(model_), nullptr, nullptr, maybe(&body)));
      return;
    }
    std::array<float, 15> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    vertices[choices_.below(15)] = static_cast<float>(number(choices_));
    std::array<std::uint32_t, 8> tets{0, 1, 2, 3, 1, 2, 3, 4};
    if (choices_.below(4) == 0) tets[choices_.below(8)] = static_cast<std::uint32_t>(index(choices_));
    check(tetsoup_simulation_add_mesh(simulation_, vertices.data(), 5, tets.data(), 2, text(), text(), &body));
  }

  void use_simulation() {
    const std::array<double, 3> at{number(choices_), number(choices_), number(choices_)};
    const std::size_t body = index(choices_);
    const auto vertex = static_cast<std::uint32_t>(index(choices_));
    std::size_t spring = index(choices_);
    switch (choices_.below(8)) {
      case 0:
        return add_body();
      case 1:
        return check(tetsoup_simulation_add_plane(maybe(simulation_), maybe(at.data()), at[0], at[1]));
      case 2:
        return check(tetsoup_simulation_add_obstacle(maybe(simulation_), maybe(soup_),
                                                     static_cast<std::int32_t>(choices_.below(10)), at[0], progress(),
                                                     left()));
      case 3:
        return check(choices_.below(2) == 0 ? tetsoup_simulation_pin(simulation_, body, vertex)
                                            : tetsoup_simulation_unpin(simulation_, body, vertex));
      case 4:
        return check(tetsoup_simulation_add_spring(simulation_, body, vertex, at.data(), at[1], &spring));
      case 5:
        return check(choices_.below(2) == 0 ? tetsoup_simulation_move_spring(simulation_, spring, at.data())
                                            : tetsoup_simulation_remove_spring(simulation_, spring));
      case 6:
        return put(body);
      default:
        // The input's own options could ask for thousands of substeps: one short step of them.
        if (!stepped_) check(tetsoup_simulation_step(simulation_, choices_.below(4) == 0 ? at[0] : 1.0 / 60));
        stepped_ = choices_.below(8) == 0;
    }
  }

  void put(std::size_t body) {
    tetsoup_floats floats{};
    check(tetsoup_simulation_positions(simulation_, body, maybe(&floats)));
    if (floats.data != nullptr)
      check(tetsoup_simulation_set_velocities(simulation_, body, maybe(floats.data),
                                              choices_.below(4) == 0 ? index(choices_) : floats.count));
  }

  // C lets a caller put any number into an enumeration; C++, in which this is written, does not.
#ifdef __clang__
  [[clang::no_sanitize("enum")]]
#endif
  void
  look() {
    tetsoup_floats floats{};
    tetsoup_indices indices{};
    const char* json = nullptr;
    const auto mesh = static_cast<tetsoup_mesh>(choices_.below(3));
    check(tetsoup_soup_vertices(soup_, maybe(&floats)));
    check(tetsoup_pipeline_vertices(pipeline_, mesh, maybe(&floats)));
    check(tetsoup_pipeline_boundary(pipeline_, mesh, maybe(&indices)));
    check(tetsoup_pipeline_cavities(pipeline_, mesh, maybe(&indices)));
    check(tetsoup_pipeline_tet_quality(pipeline_, mesh, static_cast<tetsoup_measure>(choices_.below(3)), &floats));
    check(tetsoup_pipeline_slice(pipeline_, static_cast<tetsoup_field>(choices_.below(4)),
                                 static_cast<std::int32_t>(choices_.below(4)),
                                 static_cast<std::int32_t>(index(choices_)), maybe(&floats)));
    check(tetsoup_pipeline_report(pipeline_, text(), maybe(&json)));
    const std::size_t body = index(choices_);
    check(tetsoup_simulation_surface(simulation_, body, maybe(&floats), maybe(&floats)));
    check(tetsoup_simulation_triangles(simulation_, body, maybe(&indices)));
    check(tetsoup_simulation_report(simulation_, maybe(&json)));
  }

  Choices choices_;
  std::string text_;
  int left_ = 0;
  bool stepped_ = false;
  tetsoup_soup* soup_ = nullptr;
  tetsoup_pipeline* pipeline_ = nullptr;
  tetsoup_model* model_ = nullptr;
  tetsoup_simulation* simulation_ = nullptr;
};

}  // namespace

void fuzz_one(Bytes bytes) {
  Caller(bytes).run();
}

}  // namespace tetsoup::fuzz
