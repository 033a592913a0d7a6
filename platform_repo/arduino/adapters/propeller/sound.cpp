//# header sound.h
//# unsupported four voices are mixed by a cog; an Uno makes one tone at a time
