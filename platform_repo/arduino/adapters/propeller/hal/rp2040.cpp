//# header hal
//# architecture rp2040
// The hardware layer on the RP2040, under the names of the Pico SDK, which arduino-pico's core offers to sketches.
// What each piece promises is written in docs/reference/hardware-layer.md. Interrupts of one priority wait for each other here; jobs are short.
// Servo.h and tone() are state machines of the chip's PIO, so that no interrupt moves their edges.

// ---------------------------------------------------------------- numbers

//# helper SourceInt
typedef int SourceInt;  // the int of the source, which programs keep here

// ---------------------------------------------------------------- interrupts

//# helper Uninterrupted
//#   include: <hardware/sync.h>
struct Uninterrupted {  // interrupts are off as long as it lives
  uint32_t before;
  Uninterrupted() : before(save_and_disable_interrupts()) {}
  ~Uninterrupted() { restore_interrupts(before); }
};

//# helper repeats
//#   include: <pico/time.h>
inline void repeat(repeating_timer_t &timer, uint32_t us, repeating_timer_callback_t job, void *about) {
  cancel_repeating_timer(&timer);
  add_repeating_timer_us(-(int64_t)us, job, about, &timer);
}

// ---------------------------------------------------------------- pins

//# helper Io
//#   include: <hardware/gpio.h>
//#   fidelity: output latch and direction are independent in this chip, too. The first use of a pin makes it an input without pulls; one that
//#   fidelity: a servo, a tone or a wave has is theirs until it is driven
static uint8_t *cog_pins_now = 0;  // which pins the cog that runs drives; 0 where nothing needs to know

struct Io {
  uint8_t pin;
  uint32_t mask;

  explicit Io(int32_t number) : pin(number), mask(number >= 0 && number < NUM_DIGITAL_PINS && number < 30 ? 1UL << number : 0) {
    if (mask && gpio_get_function(pin) == GPIO_FUNC_NULL) pinMode(pin, INPUT);
  }
  bool wired() const { return mask != 0; }
  bool high() const { return gpio_get_all() & mask; }
  bool driven() const { return wired() && gpio_get_dir(pin); }
  bool latch() const { return wired() && gpio_get_out_level(pin); }
  void set(bool value) const {
    if (value) gpio_set_mask(mask);
    else gpio_clr_mask(mask);
  }
  void own(bool output) const {  // the cog that runs drives the pin, or no longer does
    if (!cog_pins_now || !wired()) return;
    uint8_t bit = 1 << (pin & 7);
    if (output) cog_pins_now[pin >> 3] |= bit;
    else cog_pins_now[pin >> 3] &= ~bit;
  }
  void drive_for_library() const {  // whose own cog goes on when the caller ends
    drive(true);
    own(false);
  }
  void drive(bool output) const {
    own(output);
    if (mask && gpio_get_function(pin) != GPIO_FUNC_SIO) pinMode(pin, INPUT);  // a servo or a tone had it
    if (output) gpio_set_dir_out_masked(mask);
    else gpio_set_dir_in_masked(mask);
  }
  void level(bool value) const {
    if (!wired()) return;
    digitalWrite(pin, value);  // which ends a wave there
    set(value);
    drive(true);
  }
};

//# helper own_pins
//#   needs: Io
//#   fidelity: which pins the program drives; one that only rests at a level since setup is none
//#   ram: 4
static uint8_t own_pins[(NUM_DIGITAL_PINS + 7) / 8];

struct OwnPins {
  OwnPins() {
    if (!cog_pins_now) cog_pins_now = own_pins;
  }
};
static OwnPins own_pins_begun;

template <class Pin>
__attribute__((always_inline)) inline bool owned(const Pin &io) {
  return io.wired() && cog_pins_now[io.pin >> 3] >> (io.pin & 7) & 1;
}

//# helper KnownIo
//#   needs: Io
//#   fidelity: an Io is as fast whether the compiler knows its pin or not
typedef Io KnownIo;

inline bool pin_is_known(int32_t) { return false; }

//# helper PinInput
//#   needs: Io
//#   include: <hardware/gpio.h>
struct PinInput {  // the level of a wired pin, read fast
  uint32_t mask;

  bool wired() const { return mask; }
  bool high() const { return gpio_get_all() & mask; }
};

inline PinInput input_of(const Io &io) { return {io.mask}; }

//# helper pulse
//#   needs: Io Uninterrupted
//#   include: <hardware/gpio.h> <hardware/timer.h>
inline uint32_t next_microsecond() {  // its number, right after it began
  uint32_t before = time_us_32(), now;
  do now = time_us_32();
  while (now == before);
  return now;
}

inline void pulse(const Io &io, uint32_t width) {  // the pin, an output, is inverted for so many microseconds
  uint32_t begun;
  {
    Uninterrupted now;
    begun = next_microsecond();
    gpio_xor_mask(io.mask);
    if (width < 40) {
      while (time_us_32() - begun < width) {}
      gpio_xor_mask(io.mask);
      return;
    }
  }
  while (time_us_32() - begun < width - 20) {}
  Uninterrupted now;
  while (time_us_32() - begun < width) {}
  gpio_xor_mask(io.mask);
}

// ---------------------------------------------------------------- time of edges

//# helper edge_clock
//#   include: <hardware/timer.h>
//#   fidelity: in steps of 1 us
inline uint32_t edge_clock() { return time_us_32() * 16UL; }

//# helper edge_stamp
//#   include: <hardware/timer.h>
//#   fidelity: in steps of 1 us
inline uint16_t edge_stamp() { return (uint16_t)(time_us_32() * 16UL); }

//# helper leaves
//#   needs: Io edge_clock
inline bool leaves(const Io &io, bool high, uint32_t begun, uint32_t limit, uint32_t &at) {  // waits while the pin has the level
  do {
    at = edge_clock();
    if (io.high() != high) return true;
  } while (micros() - begun < limit);
  return false;
}

// ---------------------------------------------------------------- pin watch

//# helper PinWatch
//#   needs: Uninterrupted
//#   include: <hardware/gpio.h>
struct PinWatch {
  uint8_t pin;
  uint32_t mask, level;
  void (*changed)(PinWatch &watch);
  PinWatch *next;
};
static PinWatch *pin_watches;

inline void pins_changed() {
  for (PinWatch *watch = pin_watches; watch; watch = watch->next) {
    uint32_t level = gpio_get_all() & watch->mask;
    if (level == watch->level) continue;
    watch->level = level;
    watch->changed(*watch);
  }
}

inline void end_watch(PinWatch &watch) {
  bool others = false;
  Uninterrupted now;
  for (PinWatch **link = &pin_watches; *link; link = &(*link)->next) {
    if (*link == &watch) *link = watch.next;
    if (!*link) break;
    others = others || (*link)->mask == watch.mask;
  }
  if (!others && watch.mask) detachInterrupt(digitalPinToInterrupt(watch.pin));
}

//# helper watch_pin
//#   needs: PinWatch Uninterrupted
//#   include: <hardware/gpio.h>
inline bool watch_pin(PinWatch &watch, int16_t pin, void (*changed)(PinWatch &watch)) {  // false: no such interrupt
  if (pin < 0 || pin >= 30) return false;
  Uninterrupted now;
  watch.pin = pin;
  watch.mask = 1UL << pin;
  watch.level = gpio_get_all() & watch.mask;
  watch.changed = changed;
  watch.next = pin_watches;
  pin_watches = &watch;
  attachInterrupt(digitalPinToInterrupt(pin), pins_changed, CHANGE);
  return true;
}

// ---------------------------------------------------------------- periodic jobs

//# helper periods
//#   needs: repeats
//#   include: <pico/time.h>
inline void period_comes();

inline bool period_is_over(repeating_timer_t *) {
  period_comes();
  return true;
}

inline void count_periods() {
  static repeating_timer_t timer;
  static bool counts = false;
  if (!counts) repeat(timer, 1024, period_is_over, 0);
  counts = true;
}

//# helper frame_clock
//#   needs: repeats
//#   include: <pico/time.h>
//#   fidelity: the frames of Servo.h run beside these: a width may come a frame later
inline void frame_is_owed();
inline void frame_comes();

inline bool frame_is_due(repeating_timer_t *) {
  frame_is_owed();
  frame_comes();
  return true;
}

inline void count_frames() {
  static repeating_timer_t timer;
  static bool counts = false;
  if (!counts) repeat(timer, 20000, frame_is_due, 0);
  counts = true;
}

// ---------------------------------------------------------------- servos

//# helper ServoPin
//#   servos: 8
//#   include: <Servo.h>
//#   library: Servo
//#   fidelity: Servo.h makes pulses for at most 8 servos, none shorter than 200 us
const uint8_t servo_places = 8;

struct ServoPin {
  Servo *servo;
  uint8_t pin;

  void start(int16_t us) { servo->attach(pin, 200, 2900, us); }  // its own limits are 1000 and 2000 us
  void rest() {
    if (servo->attached()) servo->detach();
  }
};

//# helper quiet_of_servos
//#   fidelity: no interrupt makes their pulses
inline void quiet_of_servos(uint32_t us) { (void)us; }

// ---------------------------------------------------------------- tone and slow waves

//# helper tones
//#   needs: Io
inline void begin_tone(const Io &io, uint16_t frequency) { tone(io.pin, frequency); }

inline void end_tone(const Io &io) { noTone(io.pin); }

//# helper slow_wave
//#   needs: Io repeats Uninterrupted
//#   include: <hardware/gpio.h> <pico/time.h>
static repeating_timer_t slow_wave_timer;
static uint32_t slow_wave_mask;  // 0: there is none

inline bool slow_wave_due(repeating_timer_t *) {
  gpio_xor_mask(slow_wave_mask);
  return true;
}

inline bool slow_wave_runs() { return slow_wave_mask; }

inline void begin_slow_wave(const Io &io, uint8_t frequency) {  // low first, as there; a wave that runs goes on
  uint32_t half = 500000UL / frequency;
  if (slow_wave_mask) {
    Uninterrupted now;
    slow_wave_timer.delay_us = -(int64_t)half;
    return;
  }
  slow_wave_mask = io.mask;
  repeat(slow_wave_timer, half, slow_wave_due, 0);
}

inline void end_slow_wave() {
  cancel_repeating_timer(&slow_wave_timer);
  slow_wave_mask = 0;
}

// ---------------------------------------------------------------- pulses of two channels

//# helper PwmDevice
//#   include: <pico/time.h>
struct PwmDevice {
  repeating_timer_t timer;
  bool runs;
  uint32_t cycle, due;            // us; due: what comes next, from the begin of the cycle
  uint32_t asked[2], high[2];     // us, from the next cycle on and in this one
  uint32_t mask[2];               // 0: the channel is not in use
  uint8_t pin[2];
  uint8_t open;                   // bit for each channel whose pulse is still to end
};

//# helper pwm_devices
//#   needs: Io PwmDevice Uninterrupted repeats
//#   include: <hardware/gpio.h> <pico/time.h>
//#   fidelity: edges within 4 us
inline bool pwm_due(repeating_timer_t *timer) {
  PwmDevice &device = *(PwmDevice *)timer->user_data;
  uint32_t now = device.due == device.cycle ? 0 : device.due, next = device.cycle;
  for (uint8_t place = 0; place < 2; place++) {
    uint8_t bit = 1 << place;
    if (!now) {
      device.high[place] = device.asked[place];
      if (device.high[place]) gpio_set_mask(device.mask[place]);
      else gpio_clr_mask(device.mask[place]);
      if (device.high[place] && device.high[place] < device.cycle) device.open |= bit;
    } else if (device.open & bit && device.high[place] <= now) {
      gpio_clr_mask(device.mask[place]);
      device.open &= ~bit;
    }
    if (device.open & bit && device.high[place] < next) next = device.high[place];
  }
  device.due = next;
  timer->delay_us = -(int64_t)(next - now);
  return true;
}

inline void begin_pwm(PwmDevice *device, uint32_t cycle) {
  device->cycle = device->due = cycle < 20 ? 20 : cycle;
  device->open = 0;
  device->runs = true;
  for (uint8_t place = 0; place < 2; place++)
    if (device->mask[place]) Io(device->pin[place]).drive_for_library();
  repeat(device->timer, 1, pwm_due, device);
}

inline void set_pwm(PwmDevice *device, uint8_t place, const Io &io, int32_t high_us) {  // less than nothing: no more pulses
  bool on = high_us >= 0 && io.wired();
  Uninterrupted now;
  if (device->mask[place] && (!on || device->mask[place] != io.mask)) {
    Io(device->pin[place]).drive(false);
    device->mask[place] = 0;
  }
  if (!on) return;
  device->asked[place] = high_us;
  if (device->mask[place]) return;
  device->pin[place] = io.pin;
  io.set(false);
  if (device->runs) io.drive_for_library();
  device->mask[place] = io.mask;
}

inline void halt_pwm(PwmDevice *device) {
  cancel_repeating_timer(&device->timer);
  device->runs = false;
  for (uint8_t place = 0; place < 2; place++)
    if (device->mask[place]) Io(device->pin[place]).drive(false);
}

inline void end_pwm(PwmDevice *device) { halt_pwm(device); }

//# helper pwm_pair
//#   needs: Io PwmDevice pwm_devices
static PwmDevice pwm_pair;

inline void set_pwm_pair(uint8_t channel, const Io &io, uint32_t microseconds) { set_pwm(&pwm_pair, channel, io, microseconds); }

inline void begin_pwm_pair(uint32_t cycle) { begin_pwm(&pwm_pair, cycle); }

inline void end_pwm_pair() { halt_pwm(&pwm_pair); }

// ---------------------------------------------------------------- lights

//# helper LightLine
//#   needs: Io
//#   include: <hardware/gpio.h>
struct LightLine {  // interrupts are off
  uint32_t mask;

  explicit LightLine(const Io &io) : mask(io.mask) {}
  static inline __attribute__((always_inline)) void wait(uint32_t turns) {  // of 3 cycles
    asm volatile(".syntax unified\n1: subs %0, #1\n\tbne 1b" : "+l"(turns) : : "cc");
  }
  void send(uint8_t byte) const {
    const uint32_t turn = 3000000000UL / F_CPU;  // ns
    for (uint8_t bits = 8; bits; bits--, byte <<= 1) {
      bool one = byte & 0x80;
      gpio_set_mask(mask);
      wait(one ? 750 / turn : 320 / turn);
      gpio_clr_mask(mask);
      wait(one ? 350 / turn : 780 / turn);
    }
  }
};

// ---------------------------------------------------------------- two-wire bus

//# helper TwoWireBus
//#   needs: Io
//#   include: <hardware/gpio.h>
//#   fidelity: any two pins, driven low or let go, as the Propeller's library does
struct TwoWireBus {
  bool wired;
  uint8_t scl, sda;
  uint16_t half;  // us of a half period

  static uint8_t place(int32_t scl, int32_t sda) {  // of a table of two: each pair of pins has one
    static int32_t first = -1;
    int32_t both = scl << 8 | (sda & 255);
    if (first < 0) first = both;
    return first != both;
  }
  void line(uint8_t pin, bool high) const {
    Io(pin).drive(!high);
    delayMicroseconds(half / 2);
  }
  void clock(bool high) const {
    line(scl, high);
    for (uint32_t begun = micros(); high && !Io(scl).high() && micros() - begun < 10000;) {}  // a device may hold it
    delayMicroseconds(half / 2);
  }
  void open(int32_t scl_pin, int32_t sda_pin, int32_t frequency) {
    Io clock_pin(scl_pin), data_pin(sda_pin);
    wired = clock_pin.wired() && data_pin.wired();
    if (!wired) return;
    scl = scl_pin, sda = sda_pin, half = 500000L / frequency;
    for (const Io &io : {clock_pin, data_pin}) {
      io.drive(false);
      io.set(false);
      gpio_pull_up(io.pin);
    }
  }
  void close() {
    if (wired) gpio_disable_pulls(scl), gpio_disable_pulls(sda);
    wired = false;
  }
  void start() const {
    if (!wired) return;
    line(sda, true);
    clock(true);
    line(sda, false);
    clock(false);
  }
  void stop() const {
    if (!wired) return;
    line(sda, false);
    clock(true);
    line(sda, true);
  }
  bool exchange(bool out) const {
    line(sda, out);
    clock(true);
    bool in = Io(sda).high();
    clock(false);
    return in;
  }
  bool write(uint8_t byte) const {  // whether it is acknowledged
    if (!wired) return false;
    for (uint8_t bits = 8; bits; bits--, byte <<= 1) exchange(byte & 0x80);
    return !exchange(true);
  }
  uint8_t read(bool acknowledges) const {
    if (!wired) return 0;
    uint8_t byte = 0;
    for (uint8_t bits = 8; bits; bits--) byte = byte << 1 | exchange(true);
    exchange(!acknowledges);
    return byte;
  }
};

// ---------------------------------------------------------------- serial lines

//# helper console
//#   needs: Io
//#   fidelity: the console is USB, which takes no pins
inline bool is_console(int32_t rxpin, int32_t txpin) {  // 254 stands for it
  return (rxpin == 254 || txpin == 254) && !Io(rxpin).wired() && !Io(txpin).wired();
}

inline bool console_is_sent() {  // after the wait for it: how much room there is tells nothing
  Serial.flush();
  return true;
}

//# helper wait_for_console
//#   needs: simpletext.h/usb_console
inline void wait_for_console(Stream &port, int32_t bytes) { wait_for_usb(port, bytes); }

//# helper begin_console
//#   needs: simpletext.h/usb_console
inline void begin_console(uint32_t baud) { begin_usb(baud); }

//# helper SerialLine
//#   needs: Io PinWatch Uninterrupted simpletools.h/TimedInput
//#   include: <hardware/gpio.h> <hardware/timer.h>
//#   fidelity: up to 19,200 baud a byte is put together from the times of its edges, so that other interrupts go on; faster, a byte is
//#   fidelity: received and sent with interrupts off
struct SerialLine : Stream, PinWatch {
  Io receives, sends;
  bool inverts_rx, inverts_tx, open_drain, drops_echo, fast;
  uint32_t width;                      // of a bit, in 1/16 us
  volatile uint8_t head = 0, tail = 0;
  uint8_t bytes[64];
  volatile uint8_t cells = 0;          // of the byte that comes: 0 none, else the start bit and those known
  uint8_t coming;
  uint32_t begun;                      // micros of its start bit

  SerialLine(int32_t rxpin, int32_t txpin, uint8_t mode, uint32_t baudrate)
      : PinWatch(), receives(rxpin), sends(txpin), inverts_rx(mode & 1), inverts_tx(mode & 2), open_drain(mode & 4),
        drops_echo(mode & 8), fast(baudrate > 19200), width((16000000UL + baudrate / 2) / baudrate) {
    if (receives.wired()) {
      receives.drive(false);
      if (!inverts_rx) gpio_pull_up(receives.pin);  // a line that is not wired rests
    }
    if (sends.wired()) show(true);
  }
  virtual ~SerialLine() {
    end_watch(*this);
    receives.drive(false);
    sends.drive(false);
  }
  void show(bool mark) const {  // the line's level: 1 at rest
    bool lets_go = open_drain && mark;
    if (lets_go && !inverts_tx) gpio_pull_up(sends.pin);
    sends.set(mark != inverts_tx);
    sends.drive(!lets_go);
  }
  void let_go() const {
    gpio_pull_up(sends.pin);
    sends.drive(false);
  }
  void keep(uint8_t byte) {
    uint8_t next = (head + 1) & 63;
    if (next == tail) return;
    bytes[head] = byte;
    head = next;
  }
  void fill(uint32_t us, bool mark) {  // the line was at that level until so many microseconds after the start bit began
    for (; cells && us * 16 > cells * width + width / 2; cells = cells + 1) {
      if (cells == 9) {
        keep(coming);
        cells = 0;
        return;
      }
      coming = coming >> 1 | (mark ? 0x80 : 0);
    }
  }
  static void wait(uint32_t from, uint32_t sixteenths) { while ((time_us_32() - from) * 16 < sixteenths) {} }
  static void fast_edge(PinWatch &watch) {  // right behind the beginning of a start bit, with interrupts off
    SerialLine &line = static_cast<SerialLine &>(watch);
    uint32_t from = time_us_32(), rests = line.inverts_rx ? 0 : line.mask;
    uint8_t byte = 0;
    if (line.level == rests) return;
    for (uint8_t number = 0; number < 8; number++) {
      wait(from, line.width * (3 + 2 * number) / 2);
      byte = byte >> 1 | ((gpio_get_all() & line.mask) == rests ? 0x80 : 0);
    }
    wait(from, line.width * 9);
    line.level = gpio_get_all() & line.mask;
    line.keep(byte);
  }
  static void edge(PinWatch &watch) {
    SerialLine &line = static_cast<SerialLine &>(watch);
    bool mark = (line.level != 0) != line.inverts_rx;
    uint32_t now = micros(), passed = now - line.begun;
    if (line.cells == 1 && passed * 32 < line.width) line.cells = 0;  // no start bit
    if (line.cells) line.fill(passed > 60000 ? 60000 : passed, !mark);
    if (line.cells || mark) return;
    line.begun = now;
    line.cells = 1;
  }
  virtual int available() {
    Uninterrupted now;
    uint32_t passed = micros() - begun;
    if (cells && passed * 16 > width * 9 + width / 2) fill(60000, (level != 0) != inverts_rx);  // its last bits were like the stop bit
    return (head - tail) & 63;
  }
  virtual int peek() { return available() ? bytes[tail] : -1; }
  virtual int read() {
    if (!available()) return -1;
    uint8_t byte = bytes[tail];
    tail = (tail + 1) & 63;
    return byte;
  }
  virtual void flush() {}
  virtual size_t write(uint8_t byte) {
    if (!sends.wired()) return 1;
    if (frames_due) frames_due();
    frames_wait = 50;
    uint32_t start = time_us_32(), due = 0;
    uint8_t last = head;
    if (fast) {
      Uninterrupted now;
      start = time_us_32();
      for (uint16_t bits = byte << 1 | 0x200, left = 10; left; left--, bits >>= 1) {
        show(bits & 1);
        wait(start, due += width);
      }
    } else {
      for (uint16_t bits = byte << 1 | 0x200, left = 10; left; left--, bits >>= 1) {
        {
          Uninterrupted now;
          wait(start, due);
          show(bits & 1);
        }
        due += width;
        wait(start, due - 16 * 20);  // others have their time behind an edge, so that none runs when the next one is due
      }
      wait(start, due);
    }
    frames_wait = 0;
    if (drops_echo) {
      Uninterrupted now;
      head = last;
      cells = 0;
    }
    return 1;
  }
  using Print::write;
};

//# helper HalfDuplexLine
//#   needs: Io Uninterrupted
//#   include: <hardware/gpio.h> <hardware/timer.h>
//#   fidelity: 19,200 baud both ways on one line that a pull-up holds high
struct HalfDuplexLine {
  Io io;

  explicit HalfDuplexLine(uint8_t pin) : io(pin) {
    if (!io.wired()) return;
    io.drive(false);
    io.set(false);
    gpio_pull_up(io.pin);
  }
  static uint32_t at(uint8_t halves) { return 1000000UL * halves / 38400; }  // us of so many half bits
  static void wait(uint32_t begun, uint8_t halves) { while (time_us_32() - begun < at(halves)) {} }
  bool waits() const { return io.wired() && !io.high(); }  // a start bit is on the line
  void send(uint8_t byte) const {
    if (!io.wired()) return;
    Uninterrupted now;
    uint32_t begun = time_us_32();
    for (uint16_t bits = byte << 1 | 0x200, sent = 0; sent < 10; bits >>= 1) {
      io.drive(!(bits & 1));
      wait(begun, 2 * ++sent);
    }
  }
  uint8_t receive() const {  // right after the start bit began
    Uninterrupted now;
    uint32_t begun = time_us_32();
    uint8_t byte = 0;
    for (uint8_t number = 0; number < 8; number++) {
      wait(begun, 3 + 2 * number);
      byte = byte >> 1 | (io.high() ? 0x80 : 0);
    }
    wait(begun, 19);
    return byte;
  }
};

// ---------------------------------------------------------------- memory that lasts

//# helper store
//#   include: <EEPROM.h>
//#   library: EEPROM
//#   fidelity: a page of the flash, which is written anew with each byte that changes: all else stands still meanwhile
const uint32_t store_size = 4096;

inline void store_ready() {
  static bool begun = false;
  if (!begun) EEPROM.begin(store_size);
  begun = true;
}

inline uint8_t store_read(uint32_t at) {
  store_ready();
  return EEPROM.read(at);
}

inline void store_write(uint32_t at, uint8_t value) {
  if (store_read(at) == value) return;
  EEPROM.write(at, value);
  EEPROM.commit();
}

// ---------------------------------------------------------------- voltages

//# helper analog_counts
//#   fidelity: 4,096 counts of 5 V up to 3.3 V, in steps of 1
inline int32_t analog_counts(uint8_t pin) {
  if (pin >= NUM_DIGITAL_PINS) return 0;
  analogReadResolution(12);
  return analogRead(pin) * 33L / 50;  // 3.3 V of 5 V
}

//# helper output_volts
const float output_volts = 3.3f;  // of a pin that is high

// ---------------------------------------------------------------- files of the C library

//# helper own_files
//#   include: <stdio.h>
struct OwnFile {
  FILE *stream;
  int (*put)(char, FILE *);
  int (*get)(FILE *);
  void *about;
  OwnFile *next;
};
static OwnFile *own_files;
const int end_of_own_file = -1;

inline int read_own_file(void *cookie, char *to, int room) {  // a character at a time, as nobody knows how many there are
  OwnFile &file = *(OwnFile *)cookie;
  int character = room > 0 ? file.get(file.stream) : -1;
  if (character < 0) return 0;
  *to = (char)character;
  return 1;
}

inline int write_own_file(void *cookie, const char *from, int count) {
  OwnFile &file = *(OwnFile *)cookie;
  for (int done = 0; done < count; done++)
    if (file.put(from[done], file.stream)) return done ? done : -1;
  return count;
}

inline FILE *open_own_file(OwnFile &file, int (*put)(char, FILE *), int (*get)(FILE *), void *about) {
  file.put = put, file.get = get, file.about = about;
  if (!file.stream) {  // made once
    file.stream = funopen(&file, read_own_file, write_own_file, 0, 0);
    if (!file.stream) return 0;
    setvbuf(file.stream, 0, _IONBF, 0);
    file.next = own_files;
    own_files = &file;
  }
  clearerr(file.stream);
  return file.stream;
}

inline bool is_own_file(const OwnFile &file, const FILE *stream) { return stream && file.stream == stream; }

inline void *about_own_file(FILE *stream) {
  for (OwnFile *each = own_files; each; each = each->next)
    if (each->stream == stream) return each->about;
  return 0;
}

// ---------------------------------------------------------------- cogs

//# helper stack_pointer
inline const uint8_t *stack_pointer() {
  const uint8_t *now;
  asm volatile("mov %0, sp" : "=r"(now));
  return now;
}

//# helper cogs_delayed
//#   fidelity: bit n: cog n waits in delay()
static uint8_t cogs_delayed = 0;

//# helper cog_frame
//#   needs: cogs_delayed
//#   fidelity: the registers that a function must keep, and its return address
const uint8_t cog_saved = 36;
const uint16_t cog_room = 1024;  // what interrupts and calls take more of a stack than on an AVR, where they are measured

inline uint8_t *cog_frame(uint8_t *top, void (*code)()) {  // what the stack pointer of a cog that begins is
  cogs_delayed = 0;  // its number may be that of one that was ended while it waited
  uint32_t *frame = (uint32_t *)((uintptr_t)top & ~(uintptr_t)7);
  frame[-1] = (uint32_t)(uintptr_t)code;
  return (uint8_t *)(frame - 9);
}

//# helper cog_delay
//#   include: <pico/time.h>
//#   needs: cogs_delayed propeller.h/COG_SLOTS propeller.h/cog_table propeller.h/cogs_running
//#   fidelity: the core's delay() sleeps, and so would all other cogs; it is weak there. Here the processor sleeps when all of them wait so
inline void cog_sleep(uint32_t us) {
  static uint32_t due[COG_SLOTS + 1];
  uint8_t own = cog_table.now;
  due[own] = micros() + us;
  for (;;) {
    int32_t least = due[own] - micros();
    if (least <= 0) break;
    cogs_delayed |= 1 << own;
    yield();
    if (~cogs_delayed & cogs_running) continue;
    uint32_t now = micros();
    for (uint8_t cog = 0; cog <= COG_SLOTS; cog++) {
      int32_t left = due[cog] - now;
      if (cogs_running >> cog & 1 && left < least) least = left;
    }
    if (least > 20) sleep_us(least - 10);
  }
  cogs_delayed &= ~(1 << own);
}

extern "C" inline __attribute__((used)) void delay(unsigned long ms) {
  for (; ms > 1000; ms -= 1000) cog_sleep(1000000);
  cog_sleep(ms * 1000);
}

//# helper cog_switch
//#   needs: cog_delay
extern "C" void cog_switch(uint8_t **save, uint8_t *load) __attribute__((naked, noinline, used, weak));
void cog_switch(uint8_t **, uint8_t *) {
  asm volatile(
      ".syntax unified\n\tpush {r4-r7, lr}\n\tmov r4, r8\n\tmov r5, r9\n\tmov r6, r10\n\tmov r7, r11\n\tpush {r4-r7}\n\t"
      "mov r4, sp\n\tstr r4, [r0]\n\tmov sp, r1\n\t"
      "pop {r4-r7}\n\tmov r8, r4\n\tmov r9, r5\n\tmov r10, r6\n\tmov r11, r7\n\tpop {r4-r7, pc}\n");
}

//# helper cog_overflow
//#   fidelity: a cog that used more than its stack stops the program
inline void cog_overflow(uint8_t number) {
  Serial.print("\r\ncog ");
  Serial.print(number);
  Serial.println(": more stack than COG_STACK");
  for (;;) {
  }
}

//# helper cog_heap
//#   fidelity: the heap of this core does not ask where the stack is
inline void cog_heap(bool leaves_main, bool enters_main) { (void)leaves_main, (void)enters_main; }
