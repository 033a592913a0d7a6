//# header rfidser.h
// A reader of RFID cards with a serial line of 2,400 baud. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/librfidser.

//# type rfidser
//#   needs: simpletext.h/text_t
//#   fidelity: a device of text; there are no cogid and devst
typedef text_t rfidser;

//# helper RfidReader
//#   needs: simpletext.h/text_t
struct RfidReader : text_t {
  uint8_t enable;
  char id[12];
};

//# adapter rfid_disable
//#   for: void rfid_disable(rfidser *device)
//#   kind: oneToOne
//#   needs: rfidser RfidReader simpletools.h/high
//#   fidelity: exact: the line for the reader is high
//#   stack: 12 2
inline void rfid_disable(rfidser *device) {
  high(static_cast<RfidReader *>(device)->enable);
}

//# adapter rfid_enable
//#   for: void rfid_enable(rfidser *device)
//#   kind: oneToOne
//#   needs: rfidser RfidReader simpletools.h/low
//#   fidelity: exact: the line for the reader is low
//#   stack: 12 2
inline void rfid_enable(rfidser *device) {
  low(static_cast<RfidReader *>(device)->enable);
}

//# adapter rfid_reset
//#   for: void rfid_reset(rfidser *device)
//#   kind: oneToMany
//#   needs: rfidser rfid_disable rfid_enable
//#   fidelity: exact
//#   stack: 12 19
inline void rfid_reset(rfidser *device) {
  rfid_disable(device);
  rfid_enable(device);
}

//# adapter rfid_open
//#   for: rfidser *rfid_open(int soutPin, int enablePin)
//#   kind: semantic
//#   needs: rfidser RfidReader rfid_reset hal/SerialLine simpletext.h/text_t hal/watch_pin
//#   pin: soutPin interrupt in
//#   pin: enablePin digital out
//#   fidelity: it waits half a second, as there, and the reader is on
//#   stack: 37 34
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
inline rfidser *rfid_open(int32_t soutPin, int32_t enablePin) {
  RfidReader *reader = new RfidReader();
  reader->enable = (uint8_t)enablePin;
  if (soutPin >= 0 && soutPin < NUM_DIGITAL_PINS) {
    SerialLine *line = new SerialLine(soutPin, -1, 0, 2400);
    watch_pin(*line, soutPin, SerialLine::edge);
    reader->port = line;
  }
  delay(500);
  rfid_reset(reader);
  return reader;
}

//# adapter rfid_get
//#   for: char *rfid_get(rfidser *device, int timeoutms)
//#   kind: oneToMany
//#   needs: rfidser RfidReader fdserial.h/fdserial_rxCheck simpletext.h/readStr
//#   fidelity: exact: the text of the next card, of 10 characters, 50 ms after it began, or "timed out"
//#   stack: 20 2
inline char *rfid_get(rfidser *device, int32_t timeoutms) {
  RfidReader *reader = static_cast<RfidReader *>(device);
  memset(reader->id, 0, sizeof reader->id);
  for (uint32_t begun = millis(); fdserial_rxCheck(device) != '\n'; yield())
    if (millis() - begun > (uint32_t)timeoutms) return strcpy(reader->id, "timed out");
  delay(50);
  readStr(device, reader->id, sizeof reader->id);
  return reader->id;
}

//# adapter rfidser_close
//#   for: void rfidser_close(rfidser *device)
//#   kind: oneToMany
//#   needs: rfidser RfidReader hal/SerialLine simpletext.h/text_t
//#   fidelity: exact: nothing more is received, and the reader stays as it is
//#   stack: 4
inline void rfidser_close(rfidser *device) {
  RfidReader *reader = static_cast<RfidReader *>(device);
  delete static_cast<SerialLine *>(reader->port);
  delete reader;
}
