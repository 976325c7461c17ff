#include "records.h"

namespace tetsoup::python {

namespace {

nb::object plain(nb::handle value) {
  if (nb::hasattr(value, "as_dict")) return value.attr("as_dict")();
  if (!nb::isinstance<nb::list>(value)) return nb::borrow(value);
  nb::list items;
  for (const nb::handle item : nb::borrow<nb::list>(value)) items.append(plain(item));
  return items;
}

}  // namespace

nb::typed<nb::dict, nb::str, nb::any> record_as_dict(nb::handle record) {
  nb::typed<nb::dict, nb::str, nb::any> values;
  for (const nb::handle name : record.type().attr("__match_args__")) values[name] = plain(nb::getattr(record, name));
  return values;
}

nb::str describe_record(nb::handle record) {
  std::string text = nb::cast<nb::str>(record.type().attr("__name__")).c_str();
  const char* separator = "(";
  for (const nb::handle name : record.type().attr("__match_args__")) {
    text +=
        std::string(separator) + nb::cast<nb::str>(name).c_str() + "=" + nb::repr(nb::getattr(record, name)).c_str();
    separator = ", ";
  }
  return nb::str((text + ")").c_str());
}

}  // namespace tetsoup::python
