// No exception leaves a C function: each does its work in guarded(), which turns what is thrown into a status and a
// text.
#pragma once

#include <new>
#include <cstring>
#include <string>

#include "base/require.h"
#include "tetsoup/error.h"
#include "tetsoup/progress.h"
#include "tetsoup/tetsoup_c.h"

namespace tetsoup::c {

/// The text of tetsoup_last_error() on this thread.
void set_error(const char* text) noexcept;

/// Keeps a text for the caller until the next one on this thread.
const char* keep_text(std::string text);

template <class Action>
tetsoup_status guarded(const Action& action) noexcept {
  try {
    action();
    return TETSOUP_OK;
  } catch (const InvalidInput& error) {
    set_error(error.what());
    return TETSOUP_INVALID_INPUT;
  } catch (const IoError& error) {
    set_error(error.what());
    return TETSOUP_IO_ERROR;
  } catch (const Cancelled& error) {
    set_error(error.what());
    return TETSOUP_CANCELLED;
  } catch (const std::bad_alloc&) {
    set_error("there is not enough memory; fewer voxels or tets need less");
    return TETSOUP_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    set_error(error.what());
    return TETSOUP_INTERNAL_ERROR;
  } catch (...) {
    set_error("unknown error");
    return TETSOUP_INTERNAL_ERROR;
  }
}

/// The number that stands in an enumeration, which a caller in C may have set to any.
template <class Enum>
int number_of(const Enum& value) {
  int number = 0;
  static_assert(sizeof number == sizeof value);
  std::memcpy(&number, &value, sizeof number);
  return number;
}

/// @throws InvalidInput  naming the argument, if it is NULL.
template <class T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw InvalidInput(std::string(name) + " is NULL");
  return *pointer;
}

/// @throws InvalidInput  if there are items but no pointer to them.
template <class T>
const T* given_items(const T* items, std::size_t count, const char* name) {
  if (items == nullptr && count > 0) throw InvalidInput(std::string(name) + " is NULL");
  return items;
}

/// A text that may be left out.
inline const char* options_or_none(const char* json) {
  return json == nullptr ? "{}" : json;
}

Progress progress_of(tetsoup_progress progress, void* context);

}  // namespace tetsoup::c
