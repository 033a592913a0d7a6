//# header wavplayer.h
//# unsupported samples of a card are played by two cogs, and no adapter plays them
