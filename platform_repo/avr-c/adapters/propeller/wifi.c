//# header wifi.h
//# unsupported the Parallax WX module talks to a cog at 115,200 baud both ways, and no adapter does
