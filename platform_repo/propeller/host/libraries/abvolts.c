/* abvolts.h: voltages in as adcDCpropab.h reads them, voltages out as duty of P26 and P27. Sources: libabvolts (abvolts.c, abvoltsDA.c,
 * daVolts.c, daCalibrate.c, getScale.c). */
#include "abvolts.h"
#include "adcDCpropab.h"

static int out_pins[2] = {26, 27}, out_bits, in_ready;
static float scale[2] = {1, 1};

void ad_init(int csPin, int sclPin, int doPin, int diPin) {
  in_ready = 1;
  adc_init(csPin, sclPin, doPin, diPin);
}

int ad_in(int channel) {
  if (!in_ready) ad_init(21, 20, 19, 18);
  return adc_in(channel);
}

float ad_volts(int channel) { return ad_in(channel) * 5.0 / 4096.0; }

void da_init(int pinDA0, int pinDA1) {
  out_pins[0] = pinDA0;
  out_pins[1] = pinDA1;
}

void da_res(int bits) { out_bits = bits; }

void da_out(int channel, int daVal) {
  if (!out_bits) out_bits = 8;
  dac_ctr_res(out_bits);
  dac_ctr(out_pins[channel != 0], channel != 0, daVal);
}

void da_stop(void) { dac_ctr_stop(); }

void da_volts(int channel, float daVal) {
  if (!out_bits) da_out(channel, 0);
  int steps = 1 << out_bits;
  float level = daVal * (steps / 3.3) * scale[channel & 1];
  if (level - (int)level >= 0.5) level += 1;
  int whole = (int)level;
  da_out(channel, whole < 0 ? 0 : whole >= steps ? steps - 1 : whole);
}

void da_setupScale(void) {
  enum { READINGS = 40 };
  float sum[2] = {0, 0};
  for (int side = 0; side < 2; side++) high(26 + side);
  pause(5);
  for (int turn = 0; turn < READINGS; turn++) {
    for (int side = 0; side < 2; side++) {
      float volts = ad_volts(side);
      if (!turn && (volts <= 3.1 || volts >= 3.5)) {
        if (!side) ad_volts(1);
        putStr("Error");  /* the words of the library are its own */
        return;
      }
      sum[side] += volts;
    }
  }
  ee_putStr((unsigned char *)"abvolts", 8, _abvolts_EE_start_);
  for (int side = 0; side < 2; side++) {
    scale[side] = 3.3 / (sum[side] / READINGS);
    ee_putFloat32(scale[side], _abvolts_EE_start_ + 8 + 4 * side);
    low(26 + side);
    input(26 + side);
  }
  print("Ch0 scalar = %f\nCh1 scalar = %f\n\n", scale[0], scale[1]);
}

void da_useScale(void) {
  unsigned char mark[8];
  ee_getStr(mark, 8, _abvolts_EE_start_);
  mark[7] = 0;
  if (strcmp((char *)mark, "abvolts")) return;
  for (int side = 0; side < 2; side++) scale[side] = ee_getFloat32(_abvolts_EE_start_ + 8 + 4 * side);
}
