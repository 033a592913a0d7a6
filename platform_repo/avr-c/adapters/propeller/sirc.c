//# header sirc.h
// Remote controls of Sony, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Remote/libsirc (sirc.h, sirc.c).

//# constant ENTER
//#   fidelity: exact
#define ENTER 11

//# constant CH_UP
//#   fidelity: exact
#define CH_UP 16

//# constant CH_DN
//#   fidelity: exact
#define CH_DN 17

//# constant VOL_UP
//#   fidelity: exact
#define VOL_UP 18

//# constant VOL_DN
//#   fidelity: exact
#define VOL_DN 19

//# constant MUTE
//#   fidelity: exact
#define MUTE 20

//# constant PWR
//#   fidelity: exact
#define PWR 21

//# constant PREV_CH
//#   fidelity: exact
#define PREV_CH 59

//# constant ARROW_UP
//#   fidelity: exact
#define ARROW_UP 53

//# constant ARROW_DN
//#   fidelity: exact
#define ARROW_DN 54

//# constant ARROW_L
//#   fidelity: exact
#define ARROW_L 52

//# constant ARROW_R
//#   fidelity: exact
#define ARROW_R 51

//# helper sirc_limit
//#   ram: 4
static uint32_t sirc_limit;  // milliseconds; 0, it waits for ever

//# adapter sirc_setTimeout
//#   for: void sirc_setTimeout(int ms)
//#   kind: oneToOne
//#   needs: sirc_limit
//#   fidelity: exact
static inline void sirc_setTimeout(int32_t ms) {
  sirc_limit = ms;
}

//# adapter sirc_code
//#   for: int sirc_code(int pin, int bits)
//#   kind: oneToMany
//#   needs: sirc_limit simpletools.h/pulse_in simpletools.h/set_io_dt simpletools.h/set_io_timeout simpletools.h/Io propeller.h/clock_ms
//#   pin: pin digital in
//#   fidelity: exact: waits for a start of 2 to 2.8 ms; -1 for what is no bit, and after the timeout; sets the timeout of timed input
//#   fidelity: to 20 ms, as there
static inline int32_t sirc_code(int32_t pin, int32_t bits) {
  set_io_dt(80);
  set_io_timeout(1600000L);
  if (!io_at(pin).mask) return -1;
  uint32_t begun = clock_ms();
  int32_t width, code = 0;
  do {
    width = pulse_in(pin, 0);
    if (sirc_limit && clock_ms() - begun >= sirc_limit) return -1;
  } while (width <= 2000 || width >= 2800);
  for (int32_t bit = 0; bit < bits; bit++) {
    width = pulse_in(pin, 0);
    if (width > 1000 && width < 1400) code |= 1L << bit;
    if (width < 300 || width > 1400) return -1;
    if (sirc_limit && clock_ms() - begun >= sirc_limit) return -1;
  }
  return code;
}

//# adapter sirc_button
//#   for: int sirc_button(int pin)
//#   kind: oneToOne
//#   needs: sirc_code
//#   pin: pin digital in
//#   fidelity: exact: 0 to 9 for the digits
static inline int32_t sirc_button(int32_t pin) {
  int32_t button = sirc_code(pin, 7);
  return button < 0 || button > 9 ? button : (button + 1) % 10;
}

//# adapter sirc_device
//#   for: int sirc_device(int pin)
//#   kind: oneToOne
//#   needs: sirc_code
//#   pin: pin digital in
//#   fidelity: exact
static inline int32_t sirc_device(int32_t pin) {
  return sirc_code(pin, 12) >> 7;
}
