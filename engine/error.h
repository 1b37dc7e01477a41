#pragma once

#include <stdexcept>

namespace patina {

/// Something the user can mend: an unreadable file, an unknown name, a value out of range.
/// what() is one sentence that says what is wrong and what to do; front ends show it as it is.
/// Broken invariants are not UserErrors: they assert.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace patina
