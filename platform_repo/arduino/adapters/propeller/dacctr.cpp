//# header dacctr.h
// Mean voltages by the counters of a cog. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libdacctr (dacctr.h, dacctr.c).
// There each cog has two counters, and other cogs take new values at a rate of samples; here a timer's PWM goes on by itself.

//# constant DUTY_SE
//#   fidelity: exact; a counter's mode, of which there is none here
#define DUTY_SE (6L << 26)

//# constant NEW_COG
//#   fidelity: exact
#define NEW_COG 2L

//# type dac
//#   fidelity: its fields but daCtr; the pin is one of the target
struct dac {
  volatile int32_t daCog, daPin, daBitX, daCh, daVal;
};

//# type dacmem
//#   fidelity: the memory of a cog, which is not needed
struct dacmem {
  uint8_t unused;
};

//# helper dac_put
//#   needs: dac hal/Io
//#   setup rp2040: analogWriteFreq(20000);
inline void dac_put(const dac *da, int32_t value) {
  Io io(da->daPin);
  uint32_t fraction = (uint32_t)value << da->daBitX;  // of 2 to the power of 32; what does not fit is lost, as there
  if (io.wired()) analogWrite(io.pin, (int)(fraction >> 24));
}

//# helper dac_end
//#   needs: dac hal/Io
inline void dac_end(const dac *da) {
  Io io(da->daPin);
  if (!io.wired()) return;
  digitalWrite(io.pin, LOW);  // the timer lets go of it
  io.drive(false);
}

//# helper dac_started
//#   needs: dac
//#   fidelity: what dac_start started, by the number that it gave
//#   ram: 28
static dac *dac_started[7][2];

//# adapter dac_setup
//#   for: dac dac_setup(int pin, int channel, int bits)
//#   kind: oneToOne
//#   needs: dac
//#   pin: pin pwm out
//#   fidelity: exact: nothing is put out yet
//#   stack: 22
inline dac dac_setup(int32_t pin, int32_t channel, int32_t bits) {
  dac made;
  made.daCog = channel > 1 ? -1 : 0;
  made.daPin = pin;
  made.daBitX = 32 - bits;
  made.daCh = channel;
  made.daVal = 0;
  return made;
}

//# adapter dac_set
//#   for: void dac_set(dac *da, int value)
//#   kind: semantic
//#   needs: dac dac_put
//#   fidelity avr: the mean voltage within 0.4 % of the supply, which is 5 V here and 3.3 V there; a value for another cog is kept until dac_start
//#   fidelity other: the mean voltage within 0.4 % of the supply; a value for another cog is kept until dac_start
//#   limit avr: 490 or 980 Hz instead of megahertz: a filter needs a hundred to a thousand times the capacity
//#   limit rp2040: 20 kHz instead of megahertz: a filter needs up to fifty times the capacity
//#   limit other: 1 kHz instead of megahertz: a filter needs a hundred to a thousand times the capacity
//#   limit: 8 bits: further bits of the resolution are left out
//#   stack: 10 2
inline void dac_set(dac *da, int32_t value) {
  da->daVal = value;
  if (da->daCog >= 0) dac_put(da, value);
}

//# adapter dac_close
//#   for: void dac_close(dac *da)
//#   kind: oneToMany
//#   needs: dac dac_end
//#   fidelity: the wave ends and the pin becomes an input
//#   stack: 6 0
inline void dac_close(dac *da) {
  dac_end(da);
}

//# adapter dac_start
//#   for: int dac_start(dacmem mem, int sampleRate, dac *da0, dac *da1)
//#   kind: semantic
//#   needs: dac dacmem dac_put dac_started
//#   fidelity: both voltages are put out, and each dac_set takes effect at once, not at the next sample; -1 when seven were started
//#   limit: the number that it gives is one for dac_stop alone, no cog
//#   stack: 32 14
inline int32_t dac_start(dacmem mem, int32_t sampleRate, dac *da0, dac *da1) {
  (void)mem;
  (void)sampleRate;
  for (uint8_t number = 0; number < 7; number++) {
    if (dac_started[number][0] || dac_started[number][1]) continue;
    dac *both[2] = {da0, da1};
    for (uint8_t channel = 0; channel < 2; channel++) {
      dac *da = both[channel];
      dac_started[number][channel] = da;
      if (!da) continue;
      da->daCh = channel;
      da->daCog = number + 1;
      da->daBitX = abs(da->daBitX);
      da->daVal = channel ? (int32_t)da->daVal : abs(da->daVal);
      dac_put(da, da->daVal);
    }
    return number + 1;
  }
  return -1;
}

//# adapter dac_stop
//#   for: int dac_stop(int cogid)
//#   kind: semantic
//#   needs: dac dac_end dac_started
//#   fidelity: the voltages that dac_start put out end and the pins become inputs; the answer is 0, and undefined there
//#   stack: 13 0
inline int32_t dac_stop(int32_t cogid) {
  if (cogid < 1 || cogid > 7) return 0;
  for (dac *&da : dac_started[cogid - 1]) {
    if (!da) continue;
    dac_end(da);
    da->daCog = -1;
    da = 0;
  }
  return 0;
}
