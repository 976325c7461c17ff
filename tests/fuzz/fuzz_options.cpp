// Parts of scenes that stand alone: the first byte chooses which, the rest is the JSON. Options or InvalidInput.
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/report.h"
#include "tetsoup/scene.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  Choices choices(bytes);
  if (!choices.are_left()) return;
  const unsigned kind = choices.below(4);
  const std::string_view text = text_of(choices.rest());
  try {
    if (kind == 0) to_json(parse_mesh_options(text));
    if (kind == 1) Simulation{parse_simulation_options(text)};
    if (kind == 2) parse_material(text);
    if (kind == 3) parse_place(text);
  } catch (const InvalidInput&) {
  }
}

}  // namespace tetsoup::fuzz
