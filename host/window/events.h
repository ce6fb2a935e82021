// What a person does at a window, free of the window system: the pointer in pixels, buttons, keys.
#pragma once

namespace scree::host {

enum class EventKind { moved, pressed, released, scrolled, key_pressed, key_released, resized };

enum class Button { left, right, middle };

// Letters (as capitals), digits and ' ' '.' ',' are their own characters; other keys follow.
enum class Key : int { space = ' ', escape = 256, enter, tab, backspace, left, right, up, down, page_up, page_down, home, other };
constexpr Key key_of(char character) {
    return static_cast<Key>(character);
}

struct Event {
    EventKind kind = EventKind::moved;
    double x = 0, y = 0;  // moved, pressed, released, scrolled: pixels from the upper left corner; resized: the new size
    double amount = 0;    // scrolled: clicks, away from the person > 0
    Button button = Button::left;
    Key key = Key::other;
    bool shift = false;
};

}  // namespace scree::host
