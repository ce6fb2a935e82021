// A window that shows the pictures of a Vulkan canvas with a Dear ImGui panel over them, and reports user input.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/canvas/canvas.h"
#include "host/device_error.h"
#include "host/window/events.h"

namespace scree::host {

class Device;

// The connection to the window system. At most one at a time; create it before the device that presents, and destroy
// it after.
class Display {
public:
    Display();  // throws DeviceError when there is no display, with the window system's reason
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    std::vector<const char*> extensions() const;  // for DeviceOptions::window_extensions; throws DeviceError without Vulkan
};

// Arguments of Canvas::draw.
struct View {
    Camera camera;
    ColorScale scale;
    std::string caption;
    vec3 low{-1}, high{1};
};

class Window {
public:
    // `device` must have been opened with the display's extensions. width and height in screen units. Throws
    // DeviceError.
    Window(const Display& display, std::shared_ptr<Device> device, const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    int width() const;  // of the framebuffer, pixels; 0 while minimised
    int height() const;
    bool wants_to_close() const;
    void set_title(const std::string& title);
    // Events since the last call, without those that the panel consumed. Blocks up to `seconds` for the first one.
    std::vector<Event> poll(double seconds);

    // Call ImGui's functions for the panel between these two. The panel gets the keys in their order, over several pictures if
    // need be, so that none is lost however few pictures are drawn; without `takes_keys` they wait for the next call.
    void begin_panel(bool takes_keys = true);
    void end_panel();
    static bool edits_text();            // whether the user edits a text field of the panel now
    void forget_text(const Event& key);  // the panel does not get what this press would write
    void set_text_scale(float scale);    // of the panel; 1: letters of 15 pixels
    // Draws with the canvas (a Vulkan canvas on this device, of this size or smaller: it is enlarged) and presents the picture
    // with the panel over it; unless `anew`, the picture that the canvas drew last. Returns false if nothing was presented:
    // minimised, or resized meanwhile.
    bool show(Canvas& canvas, const View& view, bool anew = true);

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
