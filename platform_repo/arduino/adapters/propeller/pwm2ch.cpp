//# header pwm2ch.h
// Two pins with pulses of a given width in a common cycle, in the background. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Convert/libpwm2ch (pwm2ch.h, pwm2ch.c).
// Each of two devices has a compare interrupt of Timer1, which begins its cycles and ends its pulses, so that any pins serve.

//# type pwm2ch
//#   needs: hal/PwmDevice
//#   fidelity: what pwm2ch_start gives; its fields are not those of the library
struct pwm2ch : PwmDevice {};

//# adapter pwm2ch_start
//#   for: pwm2ch *pwm2ch_start(unsigned int cycleMicroseconds)
//#   kind: semantic
//#   needs: pwm2ch hal/pwm_devices
//#   fidelity: cycles from 100 us up to 4.16 s, one tick of the timer exact: 0.06 us up to 4 ms, 0.5 us up to 32 ms; of two devices both
//#   fidelity: have the ticks of the slower one
//#   limit avr: takes Timer1, which Servo.h needs: one of the two
//#   limit: a third pwm2ch makes no pulses
//#   limit: where a second pwm2ch is so much slower that the ticks change, the first one begins its cycle anew
//#   stack: 33 16
//#   interrupt: TIMER1_COMPA_vect 26
//#   interrupt: TIMER1_COMPB_vect 26
inline pwm2ch *pwm2ch_start(uint32_t cycleMicroseconds) {
  pwm2ch *device = new pwm2ch();
  begin_pwm(device, cycleMicroseconds);
  return device;
}

//# adapter pwm2ch_set
//#   for: void pwm2ch_set(pwm2ch *device, int pin, int channel, int tHigh)
//#   kind: semantic
//#   needs: pwm2ch hal/Io hal/pwm_devices
//#   pin: pin digital out
//#   fidelity: width within 8 us: the interrupts add up to 5 us; less than nothing ends the pulses, and the pin becomes an input
//#   limit: widths and rests of less than 20 us are not kept
//#   limit: of two devices, the edges of one that fall beside those of the other are up to 20 us late
//#   range: tHigh 20.. or 0: the pulse is not kept
//#   stack: 48 29
//#   interrupt: TIMER1_COMPA_vect 24
//#   interrupt: TIMER1_COMPB_vect 24
inline void pwm2ch_set(pwm2ch *device, int32_t pin, int32_t channel, int32_t tHigh) {
  set_pwm(device, channel != 0, Io(pin), tHigh);
}

//# adapter pwm2ch_stop
//#   for: void pwm2ch_stop(pwm2ch *device)
//#   kind: semantic
//#   needs: pwm2ch hal/pwm_devices
//#   fidelity: the pins become inputs
//#   stack: 35 26
//#   interrupt: TIMER1_COMPA_vect 24
//#   interrupt: TIMER1_COMPB_vect 24
inline void pwm2ch_stop(pwm2ch *device) {
  end_pwm(device);
  delete device;
}
