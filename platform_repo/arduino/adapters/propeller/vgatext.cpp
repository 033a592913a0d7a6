//# header vgatext.h
//# unsupported the picture is made by a cog at 25 MHz; an Uno cannot
