// A window: shows what a Vulkan canvas has drawn, with a panel of Dear ImGui over it, and tells what is done at it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/canvas/canvas.h"
#include "host/device_error.h"
#include "host/window/events.h"

namespace scree::host {

class Device;

// The connection to the window system. One at a time; before the device that shows something, and outliving it.
class Display {
public:
    Display();  // throws DeviceError when there is no display, with the window system's reason
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    std::vector<const char*> extensions() const;  // for DeviceOptions::window_extensions; throws DeviceError without Vulkan
};

// What a picture shows; see Canvas::draw.
struct View {
    Camera camera;
    ColorScale scale;
    std::string caption;
    vec3 low{-1}, high{1};
};

class Window {
public:
    // On a device that was opened with the display's extensions. Throws DeviceError.
    Window(const Display& display, std::shared_ptr<Device> device, const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    int width() const;  // of what can be drawn on, pixels; 0 while minimised
    int height() const;
    bool wants_to_close() const;
    void set_title(const std::string& title);
    // What happened since the last call, less what the panel took. Waits up to `seconds` if nothing has.
    std::vector<Event> poll(double seconds);

    // Between these two calls ImGui's functions lay out the panel.
    void begin_panel();
    void end_panel();
    // Draws with the canvas, which must be a Vulkan canvas on this device and of this size, and shows that with the panel over
    // it. False if the window shows nothing at present or is of another size by now.
    bool show(Canvas& canvas, const View& view);

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
