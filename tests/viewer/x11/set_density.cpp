// set_density DOTS: tells the programs that are started from now on how many dots an inch the screen has, where a
// desktop's settings write it: Xft.dpi among the root window's resources.
#include <cstdio>
#include <string>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

int main(int count, char** arguments)
{
    Display* display = count == 2 ? XOpenDisplay(nullptr) : nullptr;
    if (display == nullptr) {
        std::fputs("usage: set_density DOTS, with a display\n", stderr);
        return 2;
    }
    const std::string resources = "Xft.dpi:\t" + std::string(arguments[1]) + "\n";
    XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(resources.data()), static_cast<int>(resources.size()));
    XSetCloseDownMode(display, RetainPermanent);
    XCloseDisplay(display);
}
