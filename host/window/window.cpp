// The window on GLFW: events, Dear ImGui's context, presentation.
#define GLFW_INCLUDE_NONE
#include "host/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <utility>

#include "host/canvas/vulkan/canvas_vulkan.h"
#include "host/window/imgui_pass.h"
#include "host/window/swapchain.h"

// After the Vulkan headers, whose types GLFW needs.
#include <GLFW/glfw3.h>

namespace scree::host {
namespace {

std::string reason() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

Key key_of_glfw(int code) {
    if ((code >= GLFW_KEY_A && code <= GLFW_KEY_Z) || (code >= GLFW_KEY_0 && code <= GLFW_KEY_9)) return static_cast<Key>(code);
    switch (code) {
        case GLFW_KEY_SPACE:
        case GLFW_KEY_PERIOD:
        case GLFW_KEY_COMMA:
            return static_cast<Key>(code);
        case GLFW_KEY_ESCAPE:
            return Key::escape;
        case GLFW_KEY_ENTER:
            return Key::enter;
        case GLFW_KEY_TAB:
            return Key::tab;
        case GLFW_KEY_BACKSPACE:
            return Key::backspace;
        case GLFW_KEY_LEFT:
            return Key::left;
        case GLFW_KEY_RIGHT:
            return Key::right;
        case GLFW_KEY_UP:
            return Key::up;
        case GLFW_KEY_DOWN:
            return Key::down;
        case GLFW_KEY_PAGE_UP:
            return Key::page_up;
        case GLFW_KEY_PAGE_DOWN:
            return Key::page_down;
        case GLFW_KEY_DELETE:
            return Key::del;
        case GLFW_KEY_HOME:
            return Key::home;
        case GLFW_KEY_F1:
            return Key::f1;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            return key_of('+');
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            return key_of('-');
        case GLFW_KEY_SLASH:
            return key_of('/');
        default:
            return Key::other;
    }
}

// What the keyboard sent to the panel: a key, or a character.
struct Typed {
    int code = 0, place = 0, action = 0, modifiers = 0;  // as GLFW has them
    unsigned character = 0;                              // 0: a key
    std::uint64_t order = 0;
    bool is_modifier() const { return code >= GLFW_KEY_LEFT_SHIFT && code <= GLFW_KEY_RIGHT_SUPER; }
    // Whether the key does something itself instead of writing a character.
    bool commands() const {
        const bool with = (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0;
        return !is_modifier() && (code >= GLFW_KEY_ESCAPE || with);
    }
};

// Dear ImGui sees which keys are down when a picture begins: a key that was pressed and released since the last would be lost,
// and the order of keys and characters. What must be seen apart is therefore given to different pictures.
class Keyboard {
public:
    std::uint64_t add(Typed typed) {
        typed.order = ++last_;
        waiting_.push_back(typed);
        return last_;
    }
    void forget_text(std::uint64_t key) {
        std::erase_if(waiting_, [&](const Typed& typed) { return typed.character != 0 && typed.order == key + 1; });
    }
    void give(GLFWwindow* window) {
        std::vector<int> changed;
        bool wrote = false, commanded = false;
        for (; !waiting_.empty(); waiting_.pop_front()) {
            const Typed& next = waiting_.front();
            if (next.character != 0) {
                if (commanded) return;
                ImGui_ImplGlfw_CharCallback(window, next.character);
                wrote = true;
                continue;
            }
            const bool pressed = next.action == GLFW_PRESS, commands = next.commands();
            if (commands && (std::ranges::count(changed, next.code) != 0 || (pressed && wrote))) return;
            if (next.is_modifier() && commanded) return;
            ImGui_ImplGlfw_KeyCallback(window, next.code, next.place, next.action, next.modifiers);
            if (commands) changed.push_back(next.code);
            commanded = commanded || (commands && pressed);
        }
    }

private:
    std::deque<Typed> waiting_;
    std::uint64_t last_ = 0;
};

}  // namespace

Display::Display() {
    if (glfwInit() != GLFW_TRUE) throw DeviceError("no display: " + reason());
}
Display::~Display() {
    glfwTerminate();
}
std::vector<const char*> Display::extensions() const {
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) throw DeviceError("Vulkan cannot show pictures on this display: " + reason());
    return {names, names + count};
}

struct Window::Impl {
    Impl(std::shared_ptr<Device> opened, GLFWwindow* window);
    ~Impl();

    std::shared_ptr<Device> device;
    GLFWwindow* handle;
    std::vector<Event> events;
    double x = 0, y = 0;  // pointer position, pixels
    Keyboard keyboard;
    float text_scale = 0;
    std::unique_ptr<Swapchain> swapchain;
    std::unique_ptr<PanelPass> panel;
    VulkanObjectPool objects;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;

    void listen();
    void record(VkImage picture, const Swapchain::Target& target, int width, int height);
    void submit(const Swapchain::Target& target);

    static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
    void moved(double to_x, double to_y);
    bool is_over_panel() const;
    void clicked(int button, int action, int modifiers);
    void typed(int code, int place, int action, int modifiers);
    void set_text_scale(float scale);
};

Window::Impl::Impl(std::shared_ptr<Device> opened, GLFWwindow* window)
    : device(std::move(opened)), handle(window), objects(device) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // do not write imgui.ini
    swapchain = std::make_unique<Swapchain>(device, [this] {
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        check(glfwCreateWindowSurface(device->instance(), handle, nullptr, &surface), "making the window's surface");
        return surface;
    });
    set_text_scale(1);
    commands = objects.commands();
    fence = objects.fence();
    ImGui_ImplGlfw_InitForVulkan(handle, false);  // listen() passes on what it needs
    listen();
}

Window::Impl::~Impl() {
    device->settle();
    panel.reset();
    swapchain.reset();
    if (ImGui::GetIO().BackendPlatformUserData != nullptr) ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(handle);
}

// Letters are drawn anew at each size, with those of the legend's titles.
void Window::Impl::set_text_scale(float scale) {
    if (scale == text_scale) return;
    text_scale = scale;
    device->settle();
    panel.reset();
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    ImFontGlyphRangesBuilder letters;
    letters.AddRanges(fonts.GetGlyphRangesDefault());
    letters.AddText("ωΣµ·⁰¹²³⁴⁵⁶⁷⁸⁹⁻");
    ImVector<ImWchar> ranges;
    letters.BuildRanges(&ranges);
    const float size = std::round(15 * scale);
    if (std::filesystem::exists(SCREE_FONT)) fonts.AddFontFromFileTTF(SCREE_FONT, size, nullptr, ranges.Data);
    panel = std::make_unique<PanelPass>(device, swapchain->format());  // makes the letters
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 5;
    style.FrameRounding = 3;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

// Converts the pointer position from screen units to pixels, which differ on some displays.
void Window::Impl::moved(double to_x, double to_y) {
    int width = 0, height = 0, across = 0, down = 0;
    glfwGetWindowSize(handle, &width, &height);
    glfwGetFramebufferSize(handle, &across, &down);
    x = to_x * across / std::max(1, width);
    y = to_y * down / std::max(1, height);
    events.push_back({.kind = EventKind::moved, .x = x, .y = y});
}

// Whether the pointer is over the panel's windows as they were drawn last: between two pictures ImGui only knows what was under
// the pointer at the last one.
bool Window::Impl::is_over_panel() const {
    if (ImGui::GetIO().WantCaptureMouse) return true;
    double across = 0, down = 0;  // screen units, as ImGui's
    glfwGetCursorPos(handle, &across, &down);
    const ImVec2 pointer(static_cast<float>(across), static_cast<float>(down));
    return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [&](const ImGuiWindow* window) {
        return window->WasActive && !(window->Flags & ImGuiWindowFlags_NoMouseInputs) && window->Rect().Contains(pointer);
    });
}

void Window::Impl::clicked(int button, int action, int modifiers) {
    Event event{.kind = action == GLFW_PRESS ? EventKind::pressed : EventKind::released, .x = x, .y = y};
    if (event.kind == EventKind::pressed && is_over_panel()) return;
    event.button = button == GLFW_MOUSE_BUTTON_RIGHT    ? Button::right
                   : button == GLFW_MOUSE_BUTTON_MIDDLE ? Button::middle
                                                        : Button::left;
    event.shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    events.push_back(event);
}

void Window::Impl::typed(int code, int place, int action, int modifiers) {
    if (action == GLFW_REPEAT) return;
    const std::uint64_t order = keyboard.add({.code = code, .place = place, .action = action, .modifiers = modifiers});
    if (action == GLFW_PRESS && code != GLFW_KEY_ESCAPE && edits_text()) return;
    Event event{.kind = action == GLFW_PRESS ? EventKind::key_pressed : EventKind::key_released, .x = x, .y = y};
    event.key = key_of_glfw(code);
    event.shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    event.control = (modifiers & GLFW_MOD_CONTROL) != 0;
    event.order = order;
    events.push_back(event);
}

void Window::Impl::listen() {
    glfwSetWindowUserPointer(handle, this);
    glfwSetCursorPosCallback(handle, [](GLFWwindow* window, double to_x, double to_y) { of(window).moved(to_x, to_y); });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* window, int button, int action, int modifiers) {
        of(window).clicked(button, action, modifiers);
        ImGui_ImplGlfw_MouseButtonCallback(window, button, action, modifiers);
    });
    glfwSetKeyCallback(handle, [](GLFWwindow* window, int code, int place, int action, int modifiers) {
        of(window).typed(code, place, action, modifiers);
    });
    glfwSetCharCallback(handle,
                        [](GLFWwindow* window, unsigned character) { of(window).keyboard.add({.character = character}); });
    glfwSetWindowFocusCallback(handle, ImGui_ImplGlfw_WindowFocusCallback);
    glfwSetCursorEnterCallback(handle, ImGui_ImplGlfw_CursorEnterCallback);
    glfwSetScrollCallback(handle, [](GLFWwindow* window, double across, double amount) {
        Impl& in = of(window);
        ImGui_ImplGlfw_ScrollCallback(window, across, amount);
        if (!in.is_over_panel()) in.events.push_back({.kind = EventKind::scrolled, .x = in.x, .y = in.y, .amount = amount});
    });
    glfwSetDropCallback(handle, [](GLFWwindow* window, int count, const char** files) {
        Impl& in = of(window);
        if (count > 0) in.events.push_back({.kind = EventKind::dropped, .x = in.x, .y = in.y, .file = files[0]});
    });
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* window, int width, int height) {
        of(window).events.push_back(
            {.kind = EventKind::resized, .x = static_cast<double>(width), .y = static_cast<double>(height)});
    });
}

Window::Window(const Display&, std::shared_ptr<Device> device, const std::string& title, int width, int height) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    GLFWwindow* const window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr) throw DeviceError("the window cannot be opened: " + reason());
    glfwSetWindowSizeLimits(window, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
    interior_ = std::make_unique<Impl>(std::move(device), window);
}
Window::~Window() = default;

int Window::width() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(interior_->handle, &width, &height);
    return width;
}
int Window::height() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(interior_->handle, &width, &height);
    return height;
}
bool Window::wants_to_close() const {
    return glfwWindowShouldClose(interior_->handle) != 0;
}
void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(interior_->handle, title.c_str());
}

std::vector<Event> Window::poll(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    return std::exchange(interior_->events, {});
}

void Window::begin_panel(bool takes_keys) {
    if (takes_keys) interior_->keyboard.give(interior_->handle);
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}
void Window::end_panel() {
    ImGui::Render();
}
// WantTextInput lags by up to two pictures.
bool Window::edits_text() {
    const ImGuiID active = ImGui::GetActiveID();
    return active != 0 && ImGui::GetInputTextState(active) != nullptr;
}
void Window::forget_text(const Event& key) {
    interior_->keyboard.forget_text(key.order);
}
void Window::set_text_scale(float scale) {
    interior_->set_text_scale(scale);
}

// Copies the picture to the whole target and draws the panel over it.
void Window::Impl::record(VkImage picture, const Swapchain::Target& target, int width, int height) {
    const VulkanFunctions& vk = device->vk();
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk.vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    image_barrier(*device, commands, target.image,
                  {.to = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   .before = VK_PIPELINE_STAGE_TRANSFER_BIT,
                   .after = VK_PIPELINE_STAGE_TRANSFER_BIT,
                   .access_after = VK_ACCESS_TRANSFER_WRITE_BIT});
    const VkExtent2D extent = swapchain->extent();
    const bool enlarges =
        static_cast<std::uint32_t>(width) != extent.width || static_cast<std::uint32_t>(height) != extent.height;
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = {width, height, 1};
    blit.dstOffsets[1] = {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
    vk.vkCmdBlitImage(commands, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      1, &blit, enlarges ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
    panel->record(commands, *ImGui::GetDrawData(), target.view, extent);
    check(vk.vkEndCommandBuffer(commands), "vkEndCommandBuffer");
}

void Window::Impl::submit(const Swapchain::Target& target) {
    const VulkanFunctions& vk = device->vk();
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.waitSemaphoreCount = info.commandBufferCount = info.signalSemaphoreCount = 1;
    info.pWaitSemaphores = &target.acquired;
    info.pWaitDstStageMask = &stage;
    info.pCommandBuffers = &commands;
    info.pSignalSemaphores = &target.written;
    device->submit(info, fence);
    check(vk.vkWaitForFences(device->handle(), 1, &fence, VK_TRUE, ~std::uint64_t{0}), "waiting for the device");
    check(vk.vkResetFences(device->handle(), 1, &fence), "vkResetFences");
}

bool Window::show(Canvas& canvas, const View& view, bool anew) {
    Impl& in = *interior_;
    auto& drawing = dynamic_cast<VulkanCanvas&>(canvas);
    const int across = width(), down = height();
    if (across == 0 || down == 0 || across < drawing.options().width || down < drawing.options().height) return false;
    const VkImage picture =
        anew ? drawing.draw_there(view.camera, view.scale, view.caption, view.low, view.high) : drawing.picture_there();
    const std::optional<Swapchain::Target> target = in.swapchain->acquire(across, down);
    if (!target) return false;
    in.record(picture, *target, drawing.options().width, drawing.options().height);
    in.submit(*target);
    in.swapchain->present();
    return true;
}

}  // namespace scree::host
