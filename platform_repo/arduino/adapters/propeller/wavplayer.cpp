//# header wavplayer.h
//# unsupported samples of a card are played by two cogs; an Uno has neither the time nor the memory for both
