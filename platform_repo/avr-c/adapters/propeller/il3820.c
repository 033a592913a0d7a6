//# header il3820.h
//# unsupported the picture of the e-paper display takes 5 KB of RAM, and no adapter draws it
