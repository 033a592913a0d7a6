//# header serial.h
// Serial lines without a buffer. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/TextDevices/libsimpletext (serial.h,
// serial_open.c, serial_rxtx.c, serial_close.c).

//# type serial
//#   needs: simpletext.h/text_t
//#   fidelity: a device of text; there are no cogid and devst
typedef text_t serial;

//# constant SERIAL_MIN_PIN
//#   fidelity: exact; a port of the source
#define SERIAL_MIN_PIN 0L

//# constant SERIAL_MAX_PIN
//#   fidelity: exact; a port of the source
#define SERIAL_MAX_PIN 31L

//# helper HalfLine
//#   needs: hal/SerialLine hal/Io
//#   fidelity: a line that sends and receives at one pin does not hear itself, and lets go of the pin when it is asked for a byte
//#   ram: 22
struct HalfLine : SerialLine {
  HalfLine(int32_t rxpin, int32_t txpin, uint32_t baudrate) : SerialLine(rxpin, txpin, 0, baudrate) {}
  bool shared() const { return receives.wired() && sends.wired() && receives.pin == sends.pin; }
  virtual int available() {
    if (shared() && sends.driven()) let_go();
    return SerialLine::available();
  }
  virtual size_t write(uint8_t byte) {
    SerialLine::write(byte);
    if (shared()) {
      cells = 0;
      tail = head;
    }
    return 1;
  }
  using Print::write;
};

//# adapter serial_open
//#   for: serial *serial_open(int rxpin, int txpin, int mode, int baudrate)
//#   kind: semantic
//#   needs: serial HalfLine hal/SerialLine simpletext.h/text_t simpletext.h/ECHO_RX_TO_TX hal/watch_pin hal/console
//#   pin: rxpin interrupt in
//#   pin: txpin digital out
//#   fidelity: the line rests at once; nothing is waited for. Bytes that come while nobody asks are kept, 63 of them, and lost there
//#   limit: up to 57,600 baud away from the console, beside servos up to 19,200 and beside their feedback signals up to 9,600 baud
//#   limit: beside servos a byte waits for a time between their pulses; below 9,600 baud it does not, and they are up to 40 us longer
//#   range: baudrate 245..57600 away from RX: bytes get lost or broken
//#   range: baudrate 245..19200 beside serial.h/serial_open away from RX: a line loses bytes while another one is busy
//#   range: baudrate 245..19200 beside servo.h/ServoSlot away from RX: the interrupts of servos break bytes
//#   range: baudrate 245..9600 beside servo360.h/feedback360_edge away from RX: the interrupts of feedback signals break bytes
//#   stack: 34 8
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline serial *serial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  serial *device = new serial();
  device->terminalEcho = (mode & ECHO_RX_TO_TX) != 0;
  if (is_console(rxpin, txpin)) {
    Serial.begin(baudrate);
    device->port = &Serial;
    device->ecA = device->ecsA = '\r';
    device->ecB = '\n';
    return device;
  }
  bool receives = rxpin >= 0 && rxpin < NUM_DIGITAL_PINS, sends = txpin >= 0 && txpin < NUM_DIGITAL_PINS;
  if (receives || sends) {
    HalfLine *line = new HalfLine(rxpin, txpin, baudrate);
    if (receives) watch_pin(*line, rxpin, line->fast ? SerialLine::fast_edge : SerialLine::edge);
    device->port = line;
  }
  return device;
}

//# adapter serial_rxChar
//#   for: int serial_rxChar(serial *device)
//#   kind: oneToMany
//#   needs: serial simpletext.h/readByte
//#   fidelity: it waits for a byte, 0 to 255
//#   limit: 0 at once where the line is not wired
//#   stack: 4 0
inline int32_t serial_rxChar(serial *device) {
  return readByte(device);
}

//# adapter serial_txChar
//#   for: int serial_txChar(serial *device, int txbyte)
//#   kind: oneToOne
//#   needs: serial simpletext.h/text_t
//#   fidelity: exact: it waits until the byte is sent, and gives it back
//#   stack: 8 0
inline int32_t serial_txChar(serial *device, int32_t txbyte) {
  if (device->port) {
    device->port->write((uint8_t)txbyte);
    device->port->flush();
  }
  return txbyte;
}

//# adapter serial_close
//#   for: void serial_close(serial *device)
//#   kind: oneToMany
//#   needs: serial HalfLine simpletext.h/text_t
//#   fidelity: exact: both pins are inputs
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void serial_close(serial *device) {
  if (!device) return;
  if (device->port == &Serial) Serial.end();
  else delete static_cast<HalfLine *>(device->port);
  delete device;
}
