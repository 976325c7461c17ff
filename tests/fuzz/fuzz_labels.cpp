// Images of labels, as NRRD. A volume whose labels are as many as its voxels and whose surfaces close, or IoError.
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/label_volume.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  constexpr std::size_t kMostVoxels = 4096;  // Beyond, the reader alone.
  try {
    const LabelVolume volume = parse_label_volume(std::as_bytes(bytes), "fuzz");
    expect(volume.labels.size() == volume.size[0] * volume.size[1] * volume.size[2], "as many labels as voxels");
    if (volume.labels.size() > kMostVoxels) return;
    expect(label_hull(volume).triangles.size() <= label_surfaces(volume).face_sizes.size(), "less hull than surfaces");
  } catch (const IoError&) {
  } catch (const InvalidInput&) {  // Steps that span nothing.
  }
}

}  // namespace tetsoup::fuzz
