#pragma once

namespace patina {

/// The panels by keyboard: a key goes from one to the next, arrows then go through what is in it, Space
/// presses it, Esc steps out. While that is on, arrows and Space are not shortcuts; a click ends it.
class KeyboardFocus {
 public:
  /// Goes to the next panel, or the one before. Between frames or before the panels are drawn.
  void go(int panels);

  bool on() const;

  /// Before the panels are drawn, once a frame. @return whether Esc was pressed, and not for something inside
  /// a panel: it ended this
  bool follow();

 private:
  void leave();

  int panel_ = -1;
  bool inside_ = false;  ///< a list, a table or a field of the panel had the keys in the frame before
};

}  // namespace patina
