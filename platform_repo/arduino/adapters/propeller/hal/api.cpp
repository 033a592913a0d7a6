//# header hal
// The hardware layer on the Arduino API alone, for every processor that has no file of its own here. What each piece promises is written
// in docs/reference/hardware-layer.md; what is looser here, the pieces' limits say. Jobs run in yield(), which waits of the core and of the
// adapters call, and at uses of pins, as this API has no timer; where yield() is the core's own, a task of its system does them. There are no LightLine and no cogs: both are made of instructions.

// ---------------------------------------------------------------- numbers

//# helper SourceInt
typedef int SourceInt;  // the int of the source, which programs keep here

// ---------------------------------------------------------------- interrupts

//# helper Uninterrupted
static volatile uint8_t uninterrupted_depth;

struct Uninterrupted {  // interrupts are off as long as it lives
  Uninterrupted() {
    noInterrupts();
    uninterrupted_depth = uninterrupted_depth + 1;
  }
  ~Uninterrupted() {
    uninterrupted_depth = uninterrupted_depth - 1;
    if (!uninterrupted_depth) interrupts();
  }
};

// ---------------------------------------------------------------- pins

//# helper Io
//#   fidelity: what was last set is kept here, as the API tells neither latch nor direction; an input has no pull-up whatever its latch is
//#   limit: levels are set and read by digitalWrite() and digitalRead(), which take up to some microseconds each
[[maybe_unused]] static uint8_t *cog_pins_now = 0;  // no cogs take turns here
static void (*jobs_due)() = 0;       // does the jobs that are due; 0: there are none
static bool latches[256], outputs[256];

struct Io {
  uint8_t pin;
  bool known;

  explicit Io(int32_t number) : pin(number), known(exists(number)) {
    if (jobs_due) jobs_due();
  }
  static bool exists(int32_t number) {
#if defined(digitalPinIsValid)
    return number >= 0 && number < 255 && digitalPinIsValid(number);
#elif defined(PINS_COUNT)
    return number >= 0 && number < (int32_t)PINS_COUNT;
#else
    return number >= 0 && number < (int32_t)NUM_DIGITAL_PINS;
#endif
  }
  bool wired() const { return known; }
  bool high() const { return known && digitalRead(pin) == HIGH; }
  bool driven() const { return known && outputs[pin]; }
  bool latch() const { return known && latches[pin]; }
  void set(bool value) const {
    if (!known) return;
    latches[pin] = value;
    if (outputs[pin]) digitalWrite(pin, value ? HIGH : LOW);
  }
  void own(bool) const {}
  void drive_for_library() const { drive(true); }
  void drive(bool output) const {
    if (!known) return;
    outputs[pin] = output;
    if (!output) {
      pinMode(pin, INPUT);
      return;
    }
    if (latches[pin]) digitalWrite(pin, HIGH);  // some cores take the level before, some only after pinMode
    pinMode(pin, OUTPUT);
    digitalWrite(pin, latches[pin] ? HIGH : LOW);
  }
  void level(bool value) const {
    if (!known) return;
    digitalWrite(pin, value ? HIGH : LOW);  // which ends a wave of a timer there
    set(value);
    drive(true);
  }
};

//# helper own_pins
//#   needs: Io
inline bool owned(const Io &io) { return io.driven(); }  // Io keeps them

//# helper KnownIo
//#   needs: Io
//#   fidelity: an Io is as fast whether the compiler knows its pin or not
typedef Io KnownIo;

inline bool pin_is_known(int32_t) { return false; }

//# helper PinInput
//#   needs: Io
struct PinInput {  // the level of a wired pin
  uint8_t pin;
  bool known;

  bool wired() const { return known; }
  bool high() const {
    if (jobs_due) jobs_due();  // a loop that reads it may be a long wait
    return known && digitalRead(pin) == HIGH;
  }
};

inline PinInput input_of(const Io &io) { return {io.pin, io.wired()}; }

//# helper pulse
//#   needs: Io Uninterrupted
//#   fidelity: within 2 us and what digitalWrite() takes
//#   limit: a pulse may be 2 us longer or shorter: it is timed with micros(); from 40 us on interrupts may come within
inline void pulse(const Io &io, uint32_t width) {  // the pin, an output, is inverted for so many microseconds
  bool before = io.latch();
  uint32_t begun;
  if (width < 40) {
    Uninterrupted now;
    begun = micros();
    io.set(!before);
    delayMicroseconds(width);
    io.set(before);
    return;
  }
  begun = micros();
  io.set(!before);
  while (micros() - begun < width) {}
  io.set(before);
}

// ---------------------------------------------------------------- time of edges

//# helper edge_clock
//#   fidelity: in steps of micros(), 1 us on most cores
inline uint32_t edge_clock() { return micros() * 16UL; }

//# helper edge_stamp
//#   fidelity: in steps of micros(), 1 us on most cores
inline uint16_t edge_stamp() { return (uint16_t)(micros() * 16UL); }

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
struct PinWatch {
  uint8_t pin, level;
  void (*changed)(PinWatch &watch);
  PinWatch *next;
};
static PinWatch *pin_watches;

inline void pins_changed() {
  for (PinWatch *watch = pin_watches; watch; watch = watch->next) {
    uint8_t level = digitalRead(watch->pin) == HIGH;
    if (level == watch->level) continue;
    watch->level = level;
    watch->changed(*watch);
  }
}

inline void end_watch(PinWatch &watch) {
  bool others = false, was_one = false;
  Uninterrupted now;
  for (PinWatch **link = &pin_watches; *link;) {
    if (*link == &watch) {
      *link = watch.next;
      was_one = true;
      continue;
    }
    others = others || (*link)->pin == watch.pin;
    link = &(*link)->next;
  }
  if (was_one && !others) detachInterrupt(digitalPinToInterrupt(watch.pin));
}

//# helper watch_pin
//#   needs: Io PinWatch Uninterrupted
//#   limit: the level is read by digitalRead() in the interrupt: a pulse shorter than some microseconds may be missed
inline bool watch_pin(PinWatch &watch, int16_t pin, void (*changed)(PinWatch &watch)) {  // false: no such interrupt
  if (!Io::exists(pin) || (int)digitalPinToInterrupt(pin) < 0) return false;
  {
    Uninterrupted now;
    watch.pin = pin;
    watch.level = digitalRead(pin) == HIGH;
    watch.changed = changed;
    watch.next = pin_watches;
    pin_watches = &watch;
  }
  attachInterrupt(digitalPinToInterrupt(pin), pins_changed, CHANGE);
  return true;
}

// ---------------------------------------------------------------- periodic jobs

//# helper jobs
//#   needs: Io
//#   limit: jobs in the background (ramps, drives, encoders that are sampled, slow waves) run while the program waits or uses a pin, and
//#   limit: stand still while it only computes
static void (*each_job[3])();

inline void do_jobs() {
  static bool under_way = false;
  if (under_way) return;
  under_way = true;
  for (auto job : each_job)
    if (job) job();
  under_way = false;
}

inline void add_background(void (*job)()) {
  for (auto &place : each_job) {
    if (place == job) return;
    if (place) continue;
    place = job;
    break;
  }
  jobs_due = do_jobs;
}

extern "C" inline __attribute__((used)) void yield() { do_jobs(); }

//# helper jobs
//#   needs: Io
//#   architecture: mbed_nano
//#   include: <mbed.h>
//#   fidelity: jobs in the background are a thread beside the program, once a millisecond
static void (*each_job[3])();

inline void do_jobs() {
  for (;;) {
    for (auto job : each_job)
      if (job) job();
    rtos::ThisThread::sleep_for(std::chrono::milliseconds(1));
  }
}

inline void add_background(void (*job)()) {
  static rtos::Thread *thread = 0;
  for (auto &place : each_job) {
    if (place == job) return;
    if (place) continue;
    place = job;
    break;
  }
  if (thread) return;
  thread = new rtos::Thread(osPriorityAboveNormal);
  thread->start(do_jobs);
}

//# helper jobs
//#   needs: Io
//#   architecture: esp32
//#   fidelity: jobs in the background are a task on the program's core, once a millisecond
static void (*each_job[3])();

inline void do_jobs(void *) {
  for (;;) {
    for (auto job : each_job)
      if (job) job();
    vTaskDelay(1);
  }
}

inline void add_background(void (*job)()) {
  static bool begun = false;
  for (auto &place : each_job) {
    if (place == job) return;
    if (place) continue;
    place = job;
    break;
  }
  if (!begun) xTaskCreatePinnedToCore(do_jobs, "jobs", 4096, 0, 2, 0, xPortGetCoreID());
  begun = true;
}

//# helper is_over
inline bool is_over(uint32_t &since, uint32_t us, uint32_t most) {  // whether a period is; of those missed, at most so many are made up
  uint32_t passed = micros() - since;
  if (passed < us) return false;
  since += passed > us * most ? passed - us * (most - 1) : us;
  return true;
}

//# helper periods
//#   needs: jobs is_over
inline void period_comes();

inline void period_is_over() {
  static uint32_t since = micros();
  while (is_over(since, 1024, 20)) period_comes();
}

inline void count_periods() { add_background(period_is_over); }

//# helper frame_clock
//#   needs: jobs is_over
//#   fidelity: the frames of Servo.h run beside these: a width may come a frame later
inline void frame_is_owed();
inline void frame_comes();

inline void frame_is_due() {
  static uint32_t since = micros();
  while (is_over(since, 20000, 3)) {
    frame_is_owed();
    frame_comes();
  }
}

inline void count_frames() { add_background(frame_is_due); }

// ---------------------------------------------------------------- servos

//# helper ServoPin
//#   servos: 8
//#   include: <Servo.h>
//#   library: Servo
//#   fidelity: the pulses are those of the library Servo of the core: 544 to 2400 us are exact, shorter and longer ones as far as it goes
const uint8_t servo_places = 8;

struct ServoPin {
  Servo *servo;
  uint8_t pin;

  void start(int16_t us) {
    servo->attach(pin, 200, 2900);
    servo->writeMicroseconds(us);
  }
  void rest() {
    if (servo->attached()) servo->detach();
  }
};

//# helper ServoPin
//#   architecture: esp32
//#   servos: 8
//#   include: <ESP32Servo.h>
//#   library: ESP32Servo
//#   fidelity: the pulses are those of the library ESP32Servo
const uint8_t servo_places = 8;

struct ServoPin {
  Servo *servo;
  uint8_t pin;

  void start(int16_t us) {
    servo->attach(pin, 500, 2500);
    servo->writeMicroseconds(us);
  }
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
//#   limit: most cores make one tone at a time
inline void begin_tone(const Io &io, uint16_t frequency) { tone(io.pin, frequency); }

inline void end_tone(const Io &io) { noTone(io.pin); }

//# helper slow_wave
//#   needs: Io jobs is_over
static const Io *slow_wave_pin = 0;  // 0: there is none
static uint32_t slow_wave_half, slow_wave_since;

inline void slow_wave_due() {
  if (slow_wave_pin && is_over(slow_wave_since, slow_wave_half, 1)) slow_wave_pin->set(!slow_wave_pin->latch());
}

inline bool slow_wave_runs() { return slow_wave_pin; }

inline void begin_slow_wave(const Io &io, uint8_t frequency) {  // low first, as there; a wave that runs goes on
  static Io at(-1);
  slow_wave_half = 500000UL / frequency;
  if (slow_wave_pin) return;
  at = io;
  slow_wave_since = micros();
  slow_wave_pin = &at;
  add_background(slow_wave_due);
}

inline void end_slow_wave() { slow_wave_pin = 0; }

// ---------------------------------------------------------------- pulses of two channels

//# helper PwmDevice
struct PwmDevice {
  bool runs, used[2];
  uint32_t cycle, high[2];    // us
  uint8_t pin[2];
};

//# helper pwm_devices
//#   needs: Io PwmDevice
//#   limit: pulses come at the frequency of analogWrite(), with the share of the cycle that was asked for: motors and lamps follow, servos do
//#   limit: not; a pin without PWM is switched on from half of the cycle on
inline void show_pwm(const PwmDevice *device, uint8_t place) {
  if (!device->runs || !device->used[place]) return;
  uint32_t high = device->high[place];
  analogWrite(device->pin[place], high < device->cycle ? (uint64_t)high * 255 / device->cycle : 255);
}

inline void begin_pwm(PwmDevice *device, uint32_t cycle) {
  device->cycle = cycle < 20 ? 20 : cycle;
  device->runs = true;
  for (uint8_t place = 0; place < 2; place++) {
    if (device->used[place]) Io(device->pin[place]).drive_for_library();
    show_pwm(device, place);
  }
}

inline void set_pwm(PwmDevice *device, uint8_t place, const Io &io, int32_t high_us) {  // less than nothing: no more pulses
  bool on = high_us >= 0 && io.wired();
  if (device->used[place] && (!on || device->pin[place] != io.pin)) {
    Io(device->pin[place]).drive(false);
    device->used[place] = false;
  }
  if (!on) return;
  device->high[place] = high_us;
  if (!device->used[place]) {
    device->pin[place] = io.pin;
    device->used[place] = true;
    io.set(false);
    if (device->runs) io.drive_for_library();
  }
  show_pwm(device, place);
}

inline void halt_pwm(PwmDevice *device) {
  device->runs = false;
  for (uint8_t place = 0; place < 2; place++)
    if (device->used[place]) Io(device->pin[place]).drive(false);
}

inline void end_pwm(PwmDevice *device) { halt_pwm(device); }

//# helper pwm_pair
//#   needs: Io PwmDevice pwm_devices
static PwmDevice pwm_pair;

inline void set_pwm_pair(uint8_t channel, const Io &io, uint32_t microseconds) { set_pwm(&pwm_pair, channel, io, microseconds); }

inline void begin_pwm_pair(uint32_t cycle) { begin_pwm(&pwm_pair, cycle); }

inline void end_pwm_pair() { halt_pwm(&pwm_pair); }

// ---------------------------------------------------------------- two-wire bus

//# helper TwoWireBus
//#   needs: Io
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
  static void let_go(uint8_t pin) {
    Io(pin).drive(false);
    pinMode(pin, INPUT_PULLUP);
  }
  void line(uint8_t pin, bool high) const {
    if (high) let_go(pin);
    else Io(pin).drive(true);
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
      io.set(false);
      let_go(io.pin);
    }
  }
  void close() {
    if (wired) Io(scl).drive(false), Io(sda).drive(false);
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
//#   fidelity: the console is USB or the programmer's line, which take no pins of the board
inline bool is_console(int32_t rxpin, int32_t txpin) {  // 254 stands for it
  return (rxpin == 254 || txpin == 254) && !Io(rxpin).wired() && !Io(txpin).wired();
}

inline bool console_is_sent() {  // after the wait for it: how much room there is tells nothing
  Serial.flush();
  return true;
}

//# helper console
//#   architecture: esp32
inline bool is_console(int32_t rxpin, int32_t txpin) { return rxpin == RX && txpin == TX; }  // of UART 0, to the USB bridge

inline bool console_is_sent() {
  Serial.flush();
  return true;
}

//# helper wait_for_console
inline void wait_for_console(Stream &port, int32_t) { port.flush(); }

//# helper begin_console
inline void begin_console(uint32_t baud) { Serial.begin(baud); }

//# helper wait_for_console
//#   architecture: renesas_uno teensy mbed_nano
//#   needs: simpletext.h/usb_console
inline void wait_for_console(Stream &port, int32_t bytes) { wait_for_usb(port, bytes); }

//# helper begin_console
//#   architecture: renesas_uno teensy mbed_nano
//#   needs: simpletext.h/usb_console
inline void begin_console(uint32_t baud) { begin_usb(baud); }

//# helper SerialLine
//#   needs: Io PinWatch Uninterrupted simpletools.h/TimedInput
//#   fidelity: up to 19,200 baud a byte is put together from the times of its edges, so that other interrupts go on; faster, a byte is
//#   fidelity: received and sent with interrupts off
//#   limit: bits are timed with micros() and digitalWrite(): up to 19,200 baud within 5 %, faster lines may lose bytes
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
      if (!inverts_rx) pinMode(receives.pin, INPUT_PULLUP);  // a line that is not wired rests
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
    sends.set(mark != inverts_tx);
    if (sends.driven() == lets_go) sends.drive(!lets_go);
    if (lets_go && !inverts_tx) pinMode(sends.pin, INPUT_PULLUP);
  }
  void let_go() const {
    sends.drive(false);
    pinMode(sends.pin, INPUT_PULLUP);
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
  static void wait(uint32_t from, uint32_t sixteenths) { while ((micros() - from) * 16 < sixteenths) {} }
  static void fast_edge(PinWatch &watch) {  // right behind the beginning of a start bit, with interrupts off
    SerialLine &line = static_cast<SerialLine &>(watch);
    uint32_t from = micros(), rests = line.inverts_rx ? 0 : 1;
    uint8_t byte = 0;
    if (line.level == rests) return;
    for (uint8_t number = 0; number < 8; number++) {
      wait(from, line.width * (3 + 2 * number) / 2);
      byte = byte >> 1 | ((digitalRead(line.receives.pin) == HIGH) == rests ? 0x80 : 0);
    }
    wait(from, line.width * 9);
    line.level = digitalRead(line.receives.pin) == HIGH;
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
    uint32_t start = micros(), due = 0;
    uint8_t last = head;
    if (fast) {
      Uninterrupted now;
      start = micros();
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
//#   fidelity: 19,200 baud both ways on one line that a pull-up holds high
struct HalfDuplexLine {
  Io io;

  explicit HalfDuplexLine(uint8_t pin) : io(pin) {
    if (!io.wired()) return;
    io.set(false);
    let_go();
  }
  void let_go() const {
    io.drive(false);
    pinMode(io.pin, INPUT_PULLUP);
  }
  static uint32_t at(uint8_t halves) { return 1000000UL * halves / 38400; }  // us of so many half bits
  static void wait(uint32_t begun, uint8_t halves) { while (micros() - begun < at(halves)) {} }
  bool waits() const { return io.wired() && !io.high(); }  // a start bit is on the line
  void send(uint8_t byte) const {
    if (!io.wired()) return;
    Uninterrupted now;
    uint32_t begun = micros();
    for (uint16_t bits = byte << 1 | 0x200, sent = 0; sent < 10; bits >>= 1) {
      if (bits & 1) let_go();
      else io.drive(true);
      wait(begun, 2 * ++sent);
    }
  }
  uint8_t receive() const {  // right after the start bit began
    Uninterrupted now;
    uint32_t begun = micros();
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
//#   limit: this core has no memory that lasts under the name EEPROM: what is stored is lost without power
const uint32_t store_size = 4096;
static uint8_t stored[store_size];

inline uint8_t store_read(uint32_t at) { return stored[at]; }

inline void store_write(uint32_t at, uint8_t value) { stored[at] = value; }

//# helper store
//#   architecture: renesas_uno teensy stm32
//#   include: <EEPROM.h>
//#   library: EEPROM
//#   fidelity: as large as the library's
inline uint32_t store_bytes() { return EEPROM.length(); }
#define store_size store_bytes()

inline uint8_t store_read(uint32_t at) { return EEPROM.read(at); }

inline void store_write(uint32_t at, uint8_t value) {
  if (EEPROM.read(at) != value) EEPROM.write(at, value);
}

//# helper store
//#   architecture: esp32
//#   include: <EEPROM.h>
//#   library: EEPROM
//#   fidelity: a part of the flash, which is written anew with each byte that changes: all else stands still meanwhile
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
//#   needs: Io
//#   fidelity: 4,096 counts of 5 V up to 3.3 V, in steps of 1
inline int32_t analog_counts(uint8_t pin) {
  if (!Io::exists(pin)) return 0;
  analogReadResolution(12);
  return analogRead(pin) * 33L / 50;  // 3.3 V of 5 V
}

//# helper analog_counts
//#   architecture: renesas_uno
//#   needs: Io
//#   fidelity: 4,096 counts of the board's 5 V
inline int32_t analog_counts(uint8_t pin) {
  if (!Io::exists(pin)) return 0;
  analogReadResolution(12);
  return analogRead(pin);
}

//# helper output_volts
const float output_volts = 3.3f;  // of a pin that is high

//# helper output_volts
//#   architecture: renesas_uno
const float output_volts = 5.0f;  // of a pin that is high

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
