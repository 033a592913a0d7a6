//# header vgatext.h
//# unsupported the picture is made by a cog at 25 MHz, and no adapter makes it
