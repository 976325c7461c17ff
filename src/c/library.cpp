// C: the library itself, and the lists of what it knows by name.
#include <nlohmann/json.hpp>

#include "c/guard.h"
#include "tetsoup/engines.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/scene.h"

using namespace tetsoup;
using Json = nlohmann::ordered_json;

namespace {

/// Things with a name and a summary each.
template <class Summary>
tetsoup_status list_names(const char** json, const std::vector<std::string>& names, const Summary& summary) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    Json list = Json::array();
    for (const std::string& name : names) list.push_back({{"name", name}, {"summary", summary(name)}});
    out = c::keep_text(list.dump());
  });
}

}  // namespace

int32_t tetsoup_c_version(void) {
  return TETSOUP_C_VERSION;
}

const char* tetsoup_version(void) {
  return TETSOUP_VERSION;
}

tetsoup_status tetsoup_set_thread_count(int32_t threads) {
  return c::guarded([&] { set_thread_count(threads); });
}

int32_t tetsoup_thread_count(void) {
  return thread_count();
}

tetsoup_status tetsoup_sample_list(const char** json) {
  return list_names(json, sample_names(), sample_summary);
}

tetsoup_status tetsoup_scene_list(const char** json) {
  return list_names(json, scene_names(), scene_summary);
}

tetsoup_status tetsoup_scene_text(const char* name, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    out = c::keep_text(scene_text(make_scene(&c::given(name, "name"))));
  });
}

tetsoup_status tetsoup_format_list(const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    Json list = Json::array();
    for (const TetFormatInfo& format : tet_formats())
      list.push_back({{"name", format.name}, {"summary", format.summary}, {"extension", format.extension}});
    out = c::keep_text(list.dump());
  });
}

tetsoup_status tetsoup_engine_list(const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    Json list = Json::array();
    for (const Engine& engine : engines())
      list.push_back({{"name", engine.name},
                      {"title", engine.title},
                      {"summary", engine.summary},
                      {"extension", engine.extension},
                      {"usage", engine.usage}});
    out = c::keep_text(list.dump());
  });
}
