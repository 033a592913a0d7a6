//# header wifi.h
//# unsupported the Parallax WX module talks to a cog at 115,200 baud both ways; an Uno has no second serial line of that speed
