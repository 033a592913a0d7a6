/* spi_adc.h: four bits say which channel, then the converter sends the voltage. Sources: libspi_adc. */
#include "spi_adc.h"

float spi_adc(int ch, int mosi, int miso, int clk, int csin, float vref, int bits) {
  if (vref < 0) {
    print("Error! Float Vref = %f, should not be <= 0\n", vref);
    return -99.99f;
  }
  high(csin);
  low(csin);
  shift_out(mosi, clk, MSBFIRST, 4, ch == 0 ? 13 : 15);
  short value = shift_in(miso, clk, MSBPOST, bits);
  high(csin);
  usleep(5);
  shift_out(mosi, clk, MSBFIRST, 1, 1);
  return value * vref / (1 << bits);
}

float MCP3202_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref) { return spi_adc(ch, mosi, miso, clk, csin, vref, 12); }
float MCP3002_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref) { return spi_adc(ch, mosi, miso, clk, csin, vref, 10); }
