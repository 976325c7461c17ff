// Scene files. What is a scene is one again after it is written, and written the same; else IoError or InvalidInput.
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/scene.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  try {
    const Scene scene = parse_scene(text_of(bytes), ".", "fuzz");
    try {
      check_scene(scene);
    } catch (const InvalidInput&) {
      return;
    }
    const std::string text = scene_text(scene);
    expect(scene_text(parse_scene(text, ".", "written")) == text, "a scene that is written is read again");
    frame_count(scene);
  } catch (const IoError&) {
  } catch (const InvalidInput&) {
  }
}

}  // namespace tetsoup::fuzz
