CON
  _clkmode = xtal1 + pll16x
  _xinfreq = 5_000_000

PUB Main | x
  repeat
    !outa[16]
    waitcnt(clkfreq / 2 + cnt)
