#pragma once

namespace patina {

/// In a table of two columns: writes a field's label, with a tooltip that says what it is, and makes the next
/// item, its value, fill the second column.
void begin_field(const char* label, const char* what);

}  // namespace patina
