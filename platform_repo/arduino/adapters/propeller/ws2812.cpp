//# header ws2812.h
// Chains of coloured lights. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Light/libws2812 (ws2812.h, ws2812.c and its files
// of one function each). The library has a cog for the bits; here they are sent at once, with interrupts off.

//# constant TYPE_RGB
//#   fidelity: exact
#define TYPE_RGB 0

//# constant TYPE_GRB
//#   fidelity: exact
#define TYPE_GRB 1

//# constant COLOR
//#   fidelity: exact; wide enough, where an int has 16 bits
#define COLOR(r, g, b) ((int32_t)(r) << 16 | (int32_t)(g) << 8 | (int32_t)(b))

//# constant SCALE
//#   fidelity: exact; wide enough, where an int has 16 bits
#define SCALE(x, l) ((int32_t)(x) * (l) / 255)

//# constant COLORX
//#   fidelity: exact; wide enough, where an int has 16 bits
#define COLORX(r, g, b, l) ((int32_t)(r) * (l) / 255 << 16 | (int32_t)(g) * (l) / 255 << 8 | (int32_t)(b) * (l) / 255)

//# constant COLOR_BLACK
//#   fidelity: exact
#define COLOR_BLACK 0x000000L

//# constant COLOR_RED
//#   fidelity: exact
#define COLOR_RED 0xFF0000L

//# constant COLOR_GREEN
//#   fidelity: exact
#define COLOR_GREEN 0x00FF00L

//# constant COLOR_BLUE
//#   fidelity: exact
#define COLOR_BLUE 0x0000FFL

//# constant COLOR_WHITE
//#   fidelity: exact
#define COLOR_WHITE 0xFFFFFFL

//# constant COLOR_CYAN
//#   fidelity: exact
#define COLOR_CYAN 0x00FFFFL

//# constant COLOR_MAGENTA
//#   fidelity: exact
#define COLOR_MAGENTA 0xFF00FFL

//# constant COLOR_YELLOW
//#   fidelity: exact
#define COLOR_YELLOW 0xFFFF00L

//# constant COLOR_CHARTREUSE
//#   fidelity: exact
#define COLOR_CHARTREUSE 0x7FFF00L

//# constant COLOR_ORANGE
//#   fidelity: exact
#define COLOR_ORANGE 0xFF6000L

//# constant COLOR_AQUAMARINE
//#   fidelity: exact
#define COLOR_AQUAMARINE 0x7FFFD4L

//# constant COLOR_PINK
//#   fidelity: exact
#define COLOR_PINK 0xFF5F5FL

//# constant COLOR_TURQUOISE
//#   fidelity: exact
#define COLOR_TURQUOISE 0x3FE0C0L

//# constant COLOR_REALWHITE
//#   fidelity: exact
#define COLOR_REALWHITE 0xC8FFFFL

//# constant COLOR_INDIGO
//#   fidelity: exact
#define COLOR_INDIGO 0x3F007FL

//# constant COLOR_VIOLET
//#   fidelity: exact
#define COLOR_VIOLET 0xBF7FBFL

//# constant COLOR_MAROON
//#   fidelity: exact
#define COLOR_MAROON 0x320010L

//# constant COLOR_BROWN
//#   fidelity: exact
#define COLOR_BROWN 0x0E0600L

//# constant COLOR_CRIMSON
//#   fidelity: exact
#define COLOR_CRIMSON 0xDC283CL

//# constant COLOR_PURPLE
//#   fidelity: exact
#define COLOR_PURPLE 0x8C00FFL

//# type ws2812_t
//#   fidelity: as there; cog is -1 without a driver
struct ws2812_t {
  volatile uint32_t command;
  int32_t cog;
  uint8_t type;
  uint16_t reset;  // us
  uint32_t ended;  // us
};

//# type ws2812
//#   needs: ws2812_t
//#   fidelity: exact
typedef ws2812_t ws2812;

//# adapter ws_start
//#   for: int ws_start(ws2812_t *driver, int usreset, int ns0h, int ns0l, int ns1h, int ns1l, int type)
//#   kind: semantic
//#   needs: ws2812_t
//#   symmetric: ns0h ns0l ns1h ns1l
//#   fidelity: the rest between two frames and the order of the colours are obeyed
//#   limit: the widths of bits are always 0.375 us for 0 and 0.812 us for 1, each 1.25 us
//#   stack: 2 0
inline int32_t ws_start(ws2812_t *driver, int32_t usreset, int32_t ns0h, int32_t ns0l, int32_t ns1h, int32_t ns1l, int32_t type) {
  (void)ns0h, (void)ns0l, (void)ns1h, (void)ns1l;
  driver->command = 0;
  driver->type = type;
  driver->reset = usreset;
  driver->ended = micros();
  return driver->cog = 1;
}

//# adapter ws2812_start
//#   for: int ws2812_start(ws2812_t *driver)
//#   kind: oneToOne
//#   needs: TYPE_GRB ws2812_t ws_start
//#   fidelity: as ws_start
//#   stack: 2 0
inline int32_t ws2812_start(ws2812_t *driver) {
  return ws_start(driver, 50, 350, 800, 700, 600, TYPE_GRB);
}

//# adapter ws2812_open
//#   for: ws2812_t *ws2812_open(void)
//#   kind: oneToMany
//#   needs: ws2812_t ws2812_start
//#   fidelity: as ws_start
//#   stack: 8 6
inline ws2812_t *ws2812_open() {
  ws2812_t *driver = new ws2812_t();
  ws2812_start(driver);
  return driver;
}

//# adapter ws2812b_start
//#   for: int ws2812b_start(ws2812_t *driver)
//#   kind: oneToOne
//#   needs: TYPE_GRB ws2812_t ws_start
//#   fidelity: as ws_start
//#   stack: 2 0
inline int32_t ws2812b_start(ws2812_t *driver) {
  return ws_start(driver, 300, 200, 600, 600, 200, TYPE_GRB);
}

//# adapter ws2812b_open
//#   for: ws2812_t *ws2812b_open(void)
//#   kind: oneToMany
//#   needs: ws2812_t ws2812b_start
//#   fidelity: as ws_start
//#   stack: 8 6
inline ws2812_t *ws2812b_open() {
  ws2812_t *driver = new ws2812_t();
  ws2812b_start(driver);
  return driver;
}

//# adapter ws2812_stop
//#   for: void ws2812_stop(ws2812_t *driver)
//#   kind: oneToOne
//#   needs: ws2812_t
//#   fidelity: nothing is sent any longer
//#   stack: 0
inline void ws2812_stop(ws2812_t *driver) {
  driver->cog = -1;
}

//# adapter ws2812_close
//#   for: void ws2812_close(ws2812_t *driver)
//#   kind: oneToMany
//#   needs: ws2812_t ws2812_stop
//#   fidelity: exact
//#   stack: 4
inline void ws2812_close(ws2812_t *driver) {
  ws2812_stop(driver);
  delete driver;
}

//# adapter ws2812_set
//#   for: void ws2812_set(ws2812_t *driver, int pin, uint32_t *colors, int count)
//#   kind: semantic
//#   needs: TYPE_GRB ws2812_t hal/Io hal/LightLine hal/Uninterrupted hal/quiet_of_servos
//#   pin: pin digital out
//#   fidelity: all lights are set when it returns, which takes 33 us for each; beside servos it waits up to 20 ms for a time
//#   fidelity: between their pulses, so that these keep their widths
//#   limit: interrupts are off meanwhile, so that from 31 lights on the clock falls behind; only at 16 MHz
//#   limit: beside servos whose pulses leave no such time in a frame of 20 ms, these tremble
//#   range: count 0..30: the clock falls behind meanwhile
//#   stack: 24 4
inline void ws2812_set(ws2812_t *driver, int32_t pin, uint32_t *colors, int32_t count) {
  Io io(pin);
  if (!io.wired() || driver->cog < 0) return;
  io.set(false);
  io.drive(true);
  while (micros() - driver->ended < driver->reset) yield();
  quiet_of_servos(33UL * max(count, 0));
  const uint8_t *bytes = (const uint8_t *)colors;  // blue, green, red, none
  uint8_t first = driver->type == TYPE_GRB ? 1 : 2;
  {
    Uninterrupted now;
    LightLine line(io);
    for (uint16_t left = max(count, 0); left; left--, bytes += 4)
      for (uint8_t part = 3, place = first; part; part--, place = part == 2 ? 3 - first : 0) line.send(bytes[place]);
  }
  driver->ended = micros();
}

//# adapter ws2812_wheel
//#   for: uint32_t ws2812_wheel(int pos)
//#   kind: oneToOne
//#   needs: ws2812_wheel_dim
//#   fidelity: exact
//#   stack: 0
inline uint32_t ws2812_wheel(int32_t pos) {
  return ws2812_wheel_dim(pos, 255);
}

//# adapter ws2812_wheel_dim
//#   for: uint32_t ws2812_wheel_dim(int pos, int brightness)
//#   kind: oneToOne
//#   needs: COLORX
//#   fidelity: exact, for places of 0 to 255
//#   stack: 0
inline uint32_t ws2812_wheel_dim(int32_t pos, int32_t brightness) {
  int32_t third = pos < 85 ? 0 : pos < 170 ? 1 : 2, up = (pos - 85 * third) * 3, down = 255 - up;
  if (third == 0) return COLORX(down, up, 0, brightness);
  if (third == 1) return COLORX(0, down, up, brightness);
  return COLORX(up, 0, down, brightness);
}
