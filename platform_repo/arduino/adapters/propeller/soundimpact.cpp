//# header soundimpact.h
// A sensor that makes a pulse for each loud sound. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libsoundimpact.

//# helper SoundWatch
//#   needs: hal/PinWatch
//#   ram: 14
struct SoundWatch : PinWatch {
  volatile uint16_t count;
  int32_t process;  // what soundImpact_run gives a pointer to; 0 while nothing is counted

  static void edge(PinWatch &watch) {
    SoundWatch &sound = static_cast<SoundWatch &>(watch);
    if (sound.level) sound.count++;
  }
};
static SoundWatch sound_watch;

//# adapter soundImpact_run
//#   for: int *soundImpact_run(int pin)
//#   kind: semantic
//#   needs: SoundWatch simpletools.h/CogInfo hal/Io hal/watch_pin
//#   pin: pin interrupt in
//#   fidelity: rising edges are counted by an interrupt, those of pulses of some 10 us too; there a cog looks at the pin
//#   limit: one sensor at a time, as there
//#   stack: 10 0
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
inline CogInfo soundImpact_run(int32_t pin) {
  Io io(pin);
  if (io.wired() && !sound_watch.process) {
    io.drive(false);
    watch_pin(sound_watch, pin, SoundWatch::edge);
  }
  sound_watch.process = 1;
  return CogInfo{&sound_watch.process};
}

//# adapter soundImpact_end
//#   for: void soundImpact_end(int *processID)
//#   kind: semantic
//#   needs: SoundWatch hal/PinWatch
//#   fidelity: exact: nothing more is counted
//#   stack: 2 0
template <class Number>
inline void soundImpact_end(Number *processID) {
  if (!processID || !*processID) return;
  *processID = 0;
  end_watch(sound_watch);
}

//# adapter soundImpact_getCount
//#   for: int soundImpact_getCount(void)
//#   kind: semantic
//#   needs: SoundWatch hal/Uninterrupted
//#   fidelity: exact: how many sounds there were since the last call
//#   stack: 0
inline int32_t soundImpact_getCount() {
  Uninterrupted now;
  uint16_t count = sound_watch.count;
  sound_watch.count = 0;
  return count;
}
