// The words that stand for the library's enumerators in Python; the same as the command-line tool's.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "tetsoup/pipeline.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::python {

template <class E>
using Word = std::pair<const char*, E>;

template <class E>
inline constexpr std::array<Word<E>, 0> kWords{};

template <>
inline constexpr std::array kWords<DistanceMode>{Word<DistanceMode>{"band", DistanceMode::Band},
                                                 Word<DistanceMode>{"full", DistanceMode::Full}};
template <>
inline constexpr std::array kWords<Placement>{Word<Placement>{"closest", Placement::Closest},
                                              Word<Placement>{"entry", Placement::Entry}};
template <>
inline constexpr std::array kWords<Cavities>{Word<Cavities>{"auto", Cavities::Auto},
                                             Word<Cavities>{"fill", Cavities::Fill},
                                             Word<Cavities>{"keep", Cavities::Keep}};
template <>
inline constexpr std::array kWords<Join>{Word<Join>{"touching", Join::Touching}, Word<Join>{"near", Join::Near},
                                         Word<Join>{"all", Join::All}};
template <>
inline constexpr std::array kWords<LatticeKind>{Word<LatticeKind>{"five", LatticeKind::Five},
                                                Word<LatticeKind>{"bcc", LatticeKind::Bcc}};
template <>
inline constexpr std::array kWords<Fit>{Word<Fit>{"off", Fit::Off}, Word<Fit>{"search", Fit::Search}};
template <>
inline constexpr std::array kWords<Thin>{Word<Thin>{"keep", Thin::Keep}, Word<Thin>{"drop", Thin::Drop}};
template <>
inline constexpr std::array kWords<Cover>{Word<Cover>{"density", Cover::Density},
                                          Word<Cover>{"enclose", Cover::Enclose}, Word<Cover>{"inside", Cover::Inside}};
template <>
inline constexpr std::array kWords<Separate>{Word<Separate>{"on", Separate::Apart},
                                             Word<Separate>{"off", Separate::Together}};
template <>
inline constexpr std::array kWords<Stairs>{Word<Stairs>{"even", Stairs::Even}, Word<Stairs>{"leave", Stairs::Leave}};
template <>
inline constexpr std::array kWords<Snap>{Word<Snap>{"on", Snap::Surface}, Word<Snap>{"off", Snap::Off}};
template <>
inline constexpr std::array kWords<Touching>{Word<Touching>{"mend", Touching::Mend},
                                             Word<Touching>{"leave", Touching::Leave}};
template <>
inline constexpr std::array kWords<Bubbles>{Word<Bubbles>{"fill", Bubbles::Fill}, Word<Bubbles>{"keep", Bubbles::Keep}};
template <>
inline constexpr std::array kWords<BoundaryOnly>{Word<BoundaryOnly>{"leave", BoundaryOnly::Leave},
                                                 Word<BoundaryOnly>{"remove", BoundaryOnly::Remove},
                                                 Word<BoundaryOnly>{"split", BoundaryOnly::Split}};
template <>
inline constexpr std::array kWords<UpAxis>{Word<UpAxis>{"x", UpAxis::X}, Word<UpAxis>{"y", UpAxis::Y},
                                           Word<UpAxis>{"z", UpAxis::Z}};
template <>
inline constexpr std::array kWords<SoupClass>{
    Word<SoupClass>{"closed", SoupClass::Closed}, Word<SoupClass>{"open", SoupClass::Open},
    Word<SoupClass>{"soup", SoupClass::Soup}, Word<SoupClass>{"empty", SoupClass::Empty}};
template <>
inline constexpr std::array kWords<Stage>{Word<Stage>{"soup", Stage::Soup}, Word<Stage>{"distance", Stage::Distance},
                                          Word<Stage>{"pseudo_volume", Stage::PseudoVolume},
                                          Word<Stage>{"lattice", Stage::Lattice}, Word<Stage>{"smooth", Stage::Smooth}};

template <>
inline constexpr std::array kWords<Solver>{Word<Solver>{"implicit", Solver::Implicit},
                                           Word<Solver>{"potentials", Solver::Potentials}};
template <>
inline constexpr std::array kWords<Contacts>{Word<Contacts>{"all", Contacts::All},
                                             Word<Contacts>{"between", Contacts::Between},
                                             Word<Contacts>{"none", Contacts::None}};

template <class E>
const char* word_of(E value) {
  for (const auto& [word, named] : kWords<E>)
    if (named == value) return word;
  return "";
}

}  // namespace tetsoup::python
