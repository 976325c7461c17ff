// Embeddings, as .npz and as .embedding. An embedding whose arrays belong together, or IoError.
#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  try {
    const Embedding embedding = parse_embedding(std::as_bytes(bytes), "fuzz");
    expect(embedding.tets.size() == embedding.weights.size(), "as many tets as weights");
    expect(embedding.tets.size() == embedding.distances.size(), "as many tets as distances");
  } catch (const IoError&) {
  }
}

}  // namespace tetsoup::fuzz
