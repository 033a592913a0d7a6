//# header text2speech.h
//# unsupported speech is made by a cog from formants, 20,000 samples a second, and no adapter makes it
