//# header fingerprint.h
// A reader of fingerprints on a serial line. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libfingerprint (fingerprint.h, fingerprint.c).
// Commands and answers have eight bytes: 0xF5, the command, three parameters, 0, their exclusive or, 0xF5.

//# type fpScanner
//#   needs: simpletext.h/text_t
//#   fidelity: a device of text; there are no cogid and devst
typedef text_t fpScanner;

//# constant ACK_SUCCESS
//#   fidelity: exact
#define ACK_SUCCESS 0x00L

//# constant ACK_FAIL
//#   fidelity: exact
#define ACK_FAIL 0x01L

//# constant ACK_FULL
//#   fidelity: exact
#define ACK_FULL 0x04L

//# constant ACK_NOUSER
//#   fidelity: exact
#define ACK_NOUSER 0x05L

//# constant ACK_USER_EXISTS
//#   fidelity: exact
#define ACK_USER_EXISTS 0x07L

//# constant ACK_TIMEOUT
//#   fidelity: exact
#define ACK_TIMEOUT 0x08L

//# constant CMD_SLEEP
//#   fidelity: exact
#define CMD_SLEEP 0x2CL

//# constant CMD_SET_MODE
//#   fidelity: exact
#define CMD_SET_MODE 0x2DL

//# constant CMD_ADD_FINGERPRINT_1
//#   fidelity: exact
#define CMD_ADD_FINGERPRINT_1 0x01L

//# constant CMD_ADD_FINGERPRINT_2
//#   fidelity: exact
#define CMD_ADD_FINGERPRINT_2 0x02L

//# constant CMD_ADD_FINGERPRINT_3
//#   fidelity: exact
#define CMD_ADD_FINGERPRINT_3 0x03L

//# constant CMD_DELETE_USER
//#   fidelity: exact
#define CMD_DELETE_USER 0x04L

//# constant CMD_DELETE_ALL_USERS
//#   fidelity: exact
#define CMD_DELETE_ALL_USERS 0x05L

//# constant CMD_GET_USERS_COUNT
//#   fidelity: exact
#define CMD_GET_USERS_COUNT 0x09L

//# constant CMD_SCAN_COMPARE_1_TO_1
//#   fidelity: exact
#define CMD_SCAN_COMPARE_1_TO_1 0x0BL

//# constant CMD_SCAN_COMPARE_1_TO_N
//#   fidelity: exact
#define CMD_SCAN_COMPARE_1_TO_N 0x0CL

//# constant CMD_READ_USER_PRIVLAGE
//#   fidelity: exact
#define CMD_READ_USER_PRIVLAGE 0x0AL

//# constant CMD_SENSITIVITY
//#   fidelity: exact
#define CMD_SENSITIVITY 0x28L

//# constant CMD_SCAN_GET_IMAGE
//#   fidelity: exact
#define CMD_SCAN_GET_IMAGE 0x24L

//# constant CMD_SCAN_GET_EIGENVALS
//#   fidelity: exact
#define CMD_SCAN_GET_EIGENVALS 0x23L

//# constant CMD_SCAN_PUT_EIGENVALS
//#   fidelity: exact
#define CMD_SCAN_PUT_EIGENVALS 0x44L

//# constant CMD_PUT_EIGENVALS_COMPARE_1_TO_1
//#   fidelity: exact
#define CMD_PUT_EIGENVALS_COMPARE_1_TO_1 0x42L

//# constant CMD_PUT_EIGENVALS_COMPARE_1_TO_N
//#   fidelity: exact
#define CMD_PUT_EIGENVALS_COMPARE_1_TO_N 0x43L

//# constant CMD_GET_USER_EIGENVALS
//#   fidelity: exact
#define CMD_GET_USER_EIGENVALS 0x31L

//# constant CMD_PUT_USER_EIGENVALS
//#   fidelity: exact
#define CMD_PUT_USER_EIGENVALS 0x41L

//# constant CMD_GET_USERS_INFO
//#   fidelity: exact
#define CMD_GET_USERS_INFO 0x2BL

//# constant CMD_SET_SCAN_TIMEOUT
//#   fidelity: exact
#define CMD_SET_SCAN_TIMEOUT 0x2EL

//# adapter fingerprint_open
//#   for: fpScanner *fingerprint_open(int pin_rx, int pin_tx)
//#   kind: oneToMany
//#   needs: fpScanner fdserial.h/open_line
//#   pin: pin_rx interrupt in
//#   pin: pin_tx digital out
//#   fidelity: 19,200 baud, and a tenth of a second of waiting, as there
//#   limit: beside servos with feedback a byte may get lost
//#   stack: 24 8
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline fpScanner *fingerprint_open(int32_t pin_rx, int32_t pin_tx) {
  fpScanner *device = open_line(pin_rx, pin_tx, 0, 19200);
  delay(100);
  return device;
}

//# adapter fingerprint_close
//#   for: void fingerprint_close(fpScanner *device)
//#   kind: oneToOne
//#   needs: fpScanner fdserial.h/fdserial_close
//#   fidelity: exact
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void fingerprint_close(fpScanner *device) {
  fdserial_close(device);
}

//# adapter fingerprint_sendCommand
//#   for: void fingerprint_sendCommand(fpScanner *device, char __fpCmd, char __fpParam1, char __fpParam2, char __fpParam3)
//#   kind: oneToMany
//#   needs: fpScanner fdserial.h/fdserial_txChar
//#   fidelity: exact
//#   stack: 18 10
inline void fingerprint_sendCommand(fpScanner *device, char __fpCmd, char __fpParam1, char __fpParam2, char __fpParam3) {
  uint8_t sum = __fpCmd ^ __fpParam1 ^ __fpParam2 ^ __fpParam3;
  const uint8_t bytes[8] = {0xF5, (uint8_t)__fpCmd, (uint8_t)__fpParam1, (uint8_t)__fpParam2, (uint8_t)__fpParam3, 0, sum, 0xF5};
  for (uint8_t byte : bytes) fdserial_txChar(device, byte);
}

//# adapter fingerprint_readResponse
//#   for: void fingerprint_readResponse(fpScanner *device, char *__fpResponse)
//#   kind: oneToMany
//#   needs: fpScanner fdserial.h/fdserial_rxChar
//#   fidelity: exact: it waits for eight bytes; byte 5 of the response is 0xF5 when they are whole
//#   limit: where the line is not wired the answer is not whole, and there it waits for ever
//#   stack: 22 10
inline void fingerprint_readResponse(fpScanner *device, char *__fpResponse) {
  uint8_t bytes[8], sum = 0;
  for (uint8_t number = 0; number < 8; number++) {
    bytes[number] = (uint8_t)fdserial_rxChar(device);
    if (number > 0 && number < 6) sum ^= bytes[number];
    if (number > 1 && number < 5) __fpResponse[number - 2] = (char)bytes[number];
  }
  __fpResponse[4] = 0;
  if (bytes[0] == 0xF5 && bytes[7] == 0xF5 && bytes[6] == sum) __fpResponse[5] = (char)0xF5;
}

//# helper fingerprint_ask
//#   needs: fpScanner fingerprint_sendCommand fingerprint_readResponse
//#   fidelity: one of the bytes of the answer to a command with a number and another parameter
inline uint8_t fingerprint_ask(fpScanner *device, uint8_t command, uint16_t number, uint8_t more, uint8_t *answer) {
  char text[8] = {};
  fingerprint_sendCommand(device, (char)command, (char)(number >> 8), (char)number, (char)more);
  fingerprint_readResponse(device, text);
  if (answer) memcpy(answer, text, 3);
  return (uint8_t)text[2];
}

//# adapter fingerprint_allowOverwrite
//#   for: int fingerprint_allowOverwrite(fpScanner *device, char b)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_SET_MODE
//#   fidelity: exact
//#   stack: 32 18
inline int32_t fingerprint_allowOverwrite(fpScanner *device, char b) {
  return fingerprint_ask(device, CMD_SET_MODE, b == 0, 0, 0);
}

//# adapter fingerprint_add
//#   for: int fingerprint_add(fpScanner *device, int userId, char userLevel, int scanNumber)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask ACK_NOUSER ACK_SUCCESS CMD_ADD_FINGERPRINT_1 CMD_ADD_FINGERPRINT_2 CMD_ADD_FINGERPRINT_3
//#   fidelity: exact: all three scans a second apart, or one; the answer of a last scan is 0 whatever the reader said, as there
//#   stack: 60 46
inline int32_t fingerprint_add(fpScanner *device, int32_t userId, char userLevel, int32_t scanNumber) {
  const uint8_t scans[3] = {CMD_ADD_FINGERPRINT_1, CMD_ADD_FINGERPRINT_2, CMD_ADD_FINGERPRINT_3};
  uint8_t level = userLevel & 3;
  if (userId < 1) return ACK_NOUSER;
  if (scanNumber >= 1 && scanNumber <= 3) {
    fingerprint_ask(device, scans[scanNumber - 1], (uint16_t)userId, level, 0);
    return 0;
  }
  for (uint8_t number = 0; number < 3; number++) {
    uint8_t said = fingerprint_ask(device, scans[number], (uint16_t)userId, level, 0);
    if (number == 2) break;
    if (said != ACK_SUCCESS) return said;
    delay(1000);
  }
  return 0;
}

//# adapter fingerprint_deleteUser
//#   for: int fingerprint_deleteUser(fpScanner *device, int userId)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_DELETE_USER CMD_DELETE_ALL_USERS simpletools.h/high propeller.h/port
//#   fidelity: exact: all users when there is none of that number, and port 26 is high then; the answer is 0, as there
//#   stack: 32 18
inline int32_t fingerprint_deleteUser(fpScanner *device, int32_t userId) {
  fingerprint_ask(device, userId < 1 ? CMD_DELETE_ALL_USERS : CMD_DELETE_USER, userId < 1 ? 0 : (uint16_t)userId, 0, 0);
  if (userId < 1) high(port(26));
  return 0;
}

//# adapter fingerprint_countUsers
//#   for: int fingerprint_countUsers(fpScanner *device)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_GET_USERS_COUNT
//#   fidelity: exact: -1 when the reader says that it failed
//#   stack: 28 18
inline int32_t fingerprint_countUsers(fpScanner *device) {
  uint8_t said[3];
  return fingerprint_ask(device, CMD_GET_USERS_COUNT, 0, 0, said) ? -1 : (int32_t)said[0] << 8 | said[1];
}

//# adapter fingerprint_scan
//#   for: int fingerprint_scan(fpScanner *device, int userId, int *uid)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask ACK_SUCCESS CMD_SCAN_COMPARE_1_TO_N CMD_SCAN_COMPARE_1_TO_1 CMD_READ_USER_PRIVLAGE
//#   fidelity: exact: the level of the user, or what went wrong; uid is the user's number
//#   stack: 47 37
template <class Int> inline int32_t fingerprint_scan(fpScanner *device, int32_t userId, Int *uid) {
  uint8_t said[3];
  *uid = 0;
  if (userId < 1) {
    uint8_t level = fingerprint_ask(device, CMD_SCAN_COMPARE_1_TO_N, 0, 0, said);
    *uid = (int32_t)said[0] << 8 | said[1];
    return level;
  }
  uint8_t done = fingerprint_ask(device, CMD_SCAN_COMPARE_1_TO_1, (uint16_t)userId, 0, 0);
  if (done != ACK_SUCCESS) return done;
  *uid = userId;
  return fingerprint_ask(device, CMD_READ_USER_PRIVLAGE, (uint16_t)userId, 0, 0);
}

//# adapter fingerprint_lookupUserPrivlage
//#   for: int fingerprint_lookupUserPrivlage(fpScanner *device, int userId)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_READ_USER_PRIVLAGE
//#   fidelity: exact: the level of the user; 0 without a number, where there it is undefined
//#   stack: 32 18
inline int32_t fingerprint_lookupUserPrivlage(fpScanner *device, int32_t userId) {
  return userId > 0 ? fingerprint_ask(device, CMD_READ_USER_PRIVLAGE, (uint16_t)userId, 0, 0) : 0;
}

//# adapter fingerprint_setTimeout
//#   for: int fingerprint_setTimeout(fpScanner *device, int timeout)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_SET_SCAN_TIMEOUT
//#   fidelity: exact
//#   stack: 32 18
inline int32_t fingerprint_setTimeout(fpScanner *device, int32_t timeout) {
  return fingerprint_ask(device, CMD_SET_SCAN_TIMEOUT, (uint8_t)abs(timeout), 0, 0);
}

//# adapter fingerprint_setStrictness
//#   for: int fingerprint_setStrictness(fpScanner *device, char s_level)
//#   kind: oneToMany
//#   needs: fpScanner fingerprint_ask CMD_SENSITIVITY
//#   fidelity: exact: 0 to 9; what is more is 9
//#   stack: 32 18
inline int32_t fingerprint_setStrictness(fpScanner *device, char s_level) {
  uint8_t level = (uint8_t)s_level;
  return fingerprint_ask(device, CMD_SENSITIVITY, level > 9 ? 9 : level, 0, 0);
}
