//# header sound.h
//# unsupported four voices are mixed by a cog; adapters make one tone at a time
