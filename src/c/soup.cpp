// C: soups.
#include "c/guard.h"
#include "c/handles.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"
#include "tetsoup/samples.h"

using namespace tetsoup;

namespace {

tetsoup_soup* make_handle(RenderMesh render, TriangleSoup soup) {
  return new tetsoup_soup{std::make_shared<const c::Input>(c::Input{std::move(render), std::move(soup)})};
}

}  // namespace

tetsoup_status tetsoup_soup_sample(const char* name, double damage, uint32_t seed, tetsoup_soup** soup) {
  return c::guarded([&] {
    tetsoup_soup*& out = c::given(soup, "soup");
    TriangleSoup sample = make_sample(&c::given(name, "name"), {.damage = damage, .seed = seed});
    RenderMesh render = render_mesh_of(sample);
    out = make_handle(std::move(render), std::move(sample));
  });
}

tetsoup_status tetsoup_soup_parse(const void* bytes, size_t size, const char* name, tetsoup_soup** soup) {
  return c::guarded([&] {
    tetsoup_soup*& out = c::given(soup, "soup");
    const auto* const first = c::given_items(static_cast<const std::byte*>(bytes), size, "bytes");
    RenderMesh render = at_its_place(parse_render_mesh({first, size}, &c::given(name, "name")));
    TriangleSoup triangles = triangles_of(render);
    out = make_handle(std::move(render), std::move(triangles));
  });
}

tetsoup_status tetsoup_soup_create(const float* vertices, size_t vertex_count, const uint32_t* triangles,
                                   size_t triangle_count, tetsoup_soup** soup) {
  return c::guarded([&] {
    tetsoup_soup*& out = c::given(soup, "soup");
    TriangleSoup made{c::points_from(vertices, vertex_count, "vertices"),
                      c::items_from<3>(triangles, triangle_count, "triangles")};
    RenderMesh render = render_mesh_of(made);
    out = make_handle(std::move(render), std::move(made));
  });
}

tetsoup_status tetsoup_soup_vertices(const tetsoup_soup* soup, tetsoup_floats* vertices) {
  return c::guarded([&] { c::given(vertices, "vertices") = c::view_of(c::given(soup, "soup").input->soup.vertices); });
}

tetsoup_status tetsoup_soup_triangles(const tetsoup_soup* soup, tetsoup_indices* triangles) {
  return c::guarded(
      [&] { c::given(triangles, "triangles") = c::view_of(c::given(soup, "soup").input->soup.triangles); });
}

tetsoup_status tetsoup_soup_report(const tetsoup_soup* soup, const char** json) {
  return c::guarded([&] {
    const char*& out = c::given(json, "json");
    out = c::keep_text(to_json(clean_soup(c::given(soup, "soup").input->soup).report));
  });
}

void tetsoup_soup_destroy(tetsoup_soup* soup) {
  delete soup;
}
