//# header gps.h
// A receiver of positions on a serial line. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libgps (gps.h, gps_run.c
// and its files of one function each). The library's cog reads sentences of NMEA 0183 all the time; here a job of the background keeps
// the last one of each of the two kinds that are used, and what is asked for is read from their text then.

//# constant KNOTS
//#   fidelity: exact
#define KNOTS 0L

//# constant MPH
//#   fidelity: exact
#define MPH 1L

//# constant KPH
//#   fidelity: exact
#define KPH 2L

//# constant MPS
//#   fidelity: exact
#define MPS 3L

//# constant GPS_TRUE
//#   fidelity: exact
#define GPS_TRUE 1L

//# constant GPS_FALSE
//#   fidelity: exact
#define GPS_FALSE 0L

//# helper gps_receiver
//#   needs: hal/Uninterrupted simpletext.h/text_t
//#   fidelity: sentences of up to 82 characters, as the standard has them
//#   ram: 267
struct GpsReceiver {
  text_t *line;
  int32_t rx, tx;
  char coming[84], last[2][84];  // last: RMC, GGA
  uint8_t length;
  bool within;
  char *talkers;  // where the sources of the sentences are noted, the newest first; 0 for nowhere

  void ended() {  // a sentence is whole
    coming[length] = 0;
    bool navigation = coming[0] == 'G' || coming[0] == 'B' || coming[0] == 'Q';
    uint8_t kind = !strncmp(coming + 2, "RMC", 3) ? 0 : !strncmp(coming + 2, "GGA", 3) ? 1 : 2;
    if (!navigation || kind == 2 || length < 5) return;
    if (talkers) {
      memmove(talkers + 1, talkers, 63);
      *talkers = coming[0] == 'B' && coming[1] == 'D' ? 'B' : coming[1];
    }
    Uninterrupted now;
    memcpy(last[kind], coming, sizeof coming);
  }
  void take(char c) {
    if (c == '$') {
      within = true;
      length = 0;
    } else if (within && c == '\r') {
      within = false;
      ended();
    } else if (within && length < sizeof coming - 1) {
      coming[length++] = c;
    }
  }
};
static GpsReceiver gps_receiver;

inline void gps_listen() {  // every millisecond
  static volatile bool under_way = false;
  if (under_way || !gps_receiver.line || !gps_receiver.line->port) return;
  under_way = true;
  while (gps_receiver.line->port->available()) gps_receiver.take((char)gps_receiver.line->port->read());
  under_way = false;
}

inline void gps_field(uint8_t kind, uint8_t number, char *text) {  // up to 15 characters; an empty field is 0, as there
  uint8_t at = 0;
  {
    Uninterrupted now;
    const char *from = gps_receiver.last[kind];
    for (; number && *from; from++) number -= *from == ',';
    while (!number && from[at] && from[at] != ',' && at < 15) text[at] = from[at], at++;
  }
  if (!at) text[at++] = '0';
  text[at] = 0;
}

inline float gps_number(uint8_t kind, uint8_t number) {
  char text[16];
  gps_field(kind, number, text);
  return atof(text);
}

inline float gps_degrees(uint8_t number, char positive) {  // a place in degrees and minutes, and its side behind it
  char text[16];
  gps_field(0, number, text);
  int32_t degrees = (int32_t)atof(text) / 100;
  float minutes = atof(text) - degrees * 100;
  gps_field(0, number + 1, text);
  return (text[0] == positive && !text[1] ? 1 : -1) * (minutes / 60 + degrees);
}

//# adapter gps_open
//#   for: int gps_open(int gpsSin, int gpsSout, int gps_baud)
//#   kind: semantic
//#   needs: gps_receiver GPS_TRUE hal/Uninterrupted fdserial.h/open_line servo.h/background simpletext.h/text_t
//#   pin: gpsSin interrupt in
//#   pin: gpsSout digital out
//#   fidelity: sentences are read from now on, in the background; the library's cog begins half a second later
//#   limit: up to 19,200 baud, beside servos with feedback up to 9,600 baud
//#   stack: 28 8
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: TIMER0_COMPA_vect 50 50
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t gps_open(int32_t gpsSin, int32_t gpsSout, int32_t gps_baud) {
  gps_receiver.rx = gpsSin;
  gps_receiver.tx = gpsSout;
  gps_receiver.within = false;
  text_t *line = open_line(gpsSin, gpsSout, 0, gps_baud);
  {
    Uninterrupted now;
    gps_receiver.line = line;
  }
  sample_in_background(gps_listen);
  return GPS_TRUE;
}

//# adapter gps_close
//#   for: void gps_close()
//#   kind: semantic
//#   needs: gps_receiver hal/Uninterrupted fdserial.h/fdserial_close simpletext.h/text_t
//#   fidelity: nothing more is read, all values are 0 and the pins are inputs, as there
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void gps_close() {
  text_t *line;
  {
    Uninterrupted now;
    line = gps_receiver.line;
    gps_receiver.line = 0;
    memset(gps_receiver.last, 0, sizeof gps_receiver.last);
  }
  if (line) fdserial_close(line);
}

//# adapter gps_changeBaud
//#   for: int gps_changeBaud(int newBaudRate)
//#   kind: oneToMany
//#   needs: gps_receiver gps_open gps_close
//#   fidelity: exact: values are 0 until the next sentence
//#   stack: 46 26
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: TIMER0_COMPA_vect 50 50
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t gps_changeBaud(int32_t newBaudRate) {
  gps_close();
  delay(50);
  return gps_open(gps_receiver.rx, gps_receiver.tx, newBaudRate);
}

//# adapter gps_fix
//#   for: int gps_fix()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: 0 for none, 1 GPS, 2 DGPS and so on
//#   stack: 42 40
inline int32_t gps_fix() {
  return (int32_t)gps_number(1, 6);
}

//# adapter gps_fixValid
//#   for: int gps_fixValid()
//#   kind: oneToOne
//#   needs: gps_receiver GPS_TRUE GPS_FALSE
//#   fidelity: exact
//#   stack: 20 18
inline int32_t gps_fixValid() {
  char text[16];
  gps_field(0, 2, text);
  return text[0] == 'A' && !text[1] ? GPS_TRUE : GPS_FALSE;
}

//# adapter gps_latitude
//#   for: float gps_latitude()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: degrees, north positive, of 24 bits, as there
//#   stack: 54 40
inline float gps_latitude() {
  return gps_degrees(3, 'N');
}

//# adapter gps_longitude
//#   for: float gps_longitude()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: degrees, east positive, of 24 bits, as there
//#   stack: 54 40
inline float gps_longitude() {
  return gps_degrees(5, 'E');
}

//# adapter gps_velocity
//#   for: float gps_velocity(int units_type)
//#   kind: oneToOne
//#   needs: gps_receiver KNOTS MPH KPH MPS
//#   fidelity: exact; -1 for an unknown unit
//#   stack: 46 40
inline float gps_velocity(int32_t units_type) {
  float knots = gps_number(0, 7);
  switch (units_type) {
    case KNOTS: return knots;
    case MPH: return knots * 1.15078f;
    case KPH: return knots * 1.852f;
    case MPS: return knots * 0.51444444f;
  }
  return -1;
}

//# adapter gps_heading
//#   for: float gps_heading()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: degrees
//#   stack: 40
inline float gps_heading() {
  return gps_number(0, 8);
}

//# adapter gps_magneticVariation
//#   for: float gps_magneticVariation()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: degrees, without their side
//#   stack: 40
inline float gps_magneticVariation() {
  return gps_number(0, 10);
}

//# adapter gps_rawDate
//#   for: int gps_rawDate()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: day, month and year as one number
//#   stack: 42 40
inline int32_t gps_rawDate() {
  return (int32_t)gps_number(0, 9);
}

//# adapter gps_rawTime
//#   for: int gps_rawTime()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: hours, minutes and seconds as one number
//#   stack: 42 40
inline int32_t gps_rawTime() {
  return (int32_t)gps_number(0, 1);
}

//# adapter gps_satsTracked
//#   for: int gps_satsTracked()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact
//#   stack: 42 40
inline int32_t gps_satsTracked() {
  return (int32_t)gps_number(1, 7);
}

//# adapter gps_altitude
//#   for: float gps_altitude()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   fidelity: exact: metres
//#   stack: 40
inline float gps_altitude() {
  return gps_number(1, 9);
}

//# adapter gps_txByte
//#   for: void gps_txByte(int txByte)
//#   kind: oneToOne
//#   needs: gps_receiver simpletext.h/text_t
//#   fidelity: exact
//#   limit: a byte is sent while the program waits, and what arrives meanwhile may get lost
//#   stack: 0
inline void gps_txByte(int32_t txByte) {
  if (gps_receiver.line && gps_receiver.line->port) gps_receiver.line->port->write((uint8_t)txByte);
}

//# adapter gps_sources
//#   for: char *gps_sources()
//#   kind: oneToOne
//#   needs: gps_receiver
//#   setup: gps_receiver.talkers = (char *)memset(gps_talkers, ' ', 64);
//#   fidelity: exact: a letter for the source of each of the last 64 sentences, the newest first
//#   ram: 65
//#   stack: 2
static char gps_talkers[65];

inline char *gps_sources() {
  return gps_receiver.talkers = gps_talkers;
}
