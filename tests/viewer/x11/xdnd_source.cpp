// xdnd_source WINDOW FILE...: drops files onto the middle of an X11 window as a file manager does. Exit code 0 once the
// window says that it is done with them, 1 where it does not within kPatience.
// The source's side of "Drag-and-Drop Protocol for the X Window System" (XDND), version 5.
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{10};
constexpr long kVersion = 5;

struct Drag {
    Display* display;
    Window source, target;
    std::string uris;

    Atom atom(const char* name) const { return XInternAtom(display, name, False); }

    void tell(const char* message, const std::array<long, 4>& values) const
    {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(source);
        for (size_t i = 0; i < values.size(); ++i) {
            event.xclient.data.l[i + 1] = values[i];
        }
        XSendEvent(display, target, False, NoEventMask, &event);
        XFlush(display);
    }

    // The target asks for what is dragged.
    void answer(const XSelectionRequestEvent& request) const
    {
        XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris.data()), static_cast<int>(uris.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(display, request.requestor, False, NoEventMask, &event);
        XFlush(display);
    }

    // Answers requests until the target sends the message; false where it does not.
    bool waitFor(const char* message, XClientMessageEvent& answered) const
    {
        for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
            if (XPending(display) == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                continue;
            }
            XEvent event;
            XNextEvent(display, &event);
            if (event.type == SelectionRequest) {
                answer(event.xselectionrequest);
            } else if (event.type == ClientMessage && event.xclient.message_type == atom(message)) {
                answered = event.xclient;
                return true;
            }
        }
        std::fprintf(stderr, "xdnd_source: the window sends no %s\n", message);
        return false;
    }

    bool run() const
    {
        Window child = None;
        XWindowAttributes size{};
        int x = 0, y = 0;
        XGetWindowAttributes(display, target, &size);
        XTranslateCoordinates(display, target, DefaultRootWindow(display), size.width / 2, size.height / 2, &x, &y,
                              &child);
        XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);
        const auto copy = static_cast<long>(atom("XdndActionCopy"));
        tell("XdndEnter", {kVersion << 24, static_cast<long>(atom("text/uri-list")), None, None});
        tell("XdndPosition", {0, (static_cast<long>(x) << 16) | y, CurrentTime, copy});
        XClientMessageEvent status{}, finished{};
        if (!waitFor("XdndStatus", status)) {
            return false;
        }
        if ((status.data.l[1] & 1) == 0) {
            std::fputs("xdnd_source: the window takes no drop\n", stderr);
            return false;
        }
        tell("XdndDrop", {0, CurrentTime, 0, 0});
        return waitFor("XdndFinished", finished);
    }
};

// What a URI may not hold as it is (RFC 3986, 2.3) goes as percent signs and hexadecimal digits.
std::string uriOf(const std::string& file)
{
    std::string uri = "file://";
    for (const char c : std::filesystem::absolute(file).string()) {
        const bool isPlain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                             std::string_view("/-._~").find(c) != std::string_view::npos;
        std::array<char, 4> coded{};
        std::snprintf(coded.data(), coded.size(), "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
        uri += isPlain ? std::string(1, c) : std::string(coded.data());
    }
    return uri + "\r\n";
}

} // namespace

int main(int count, char** arguments)
{
    Display* display = count > 2 ? XOpenDisplay(nullptr) : nullptr;
    if (display == nullptr) {
        std::fputs("usage: xdnd_source WINDOW FILE..., with a display\n", stderr);
        return 2;
    }
    Drag drag{display, XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0),
              std::strtoul(arguments[1], nullptr, 0), ""};
    for (int i = 2; i < count; ++i) {
        drag.uris += uriOf(arguments[i]);
    }
    const bool isDone = drag.run();
    XCloseDisplay(display);
    return isDone ? 0 : 1;
}
