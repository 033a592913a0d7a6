//# header wifi.h
//# unsupported the Parallax WX module talks to a cog at 115,200 baud both ways, and no adapter does

// ---------------------------------------------------------------- values of the header

//# constant WX_ALL_COM
//#   fidelity: exact
#define WX_ALL_COM (-1L)

//# constant USB_PGM_TERM
//#   fidelity: exact
#define USB_PGM_TERM (-2L)

//# constant USB_PGM
//#   fidelity: exact
#define USB_PGM (-3L)

//# constant ARG
//#   fidelity: exact
#define ARG 0xE6L

//# constant CONNECT
//#   fidelity: exact
#define CONNECT 0xE4L

//# constant CLOSE
//#   fidelity: exact
#define CLOSE 0xE8L

//# constant CHECK
//#   fidelity: exact
#define CHECK 0xEEL

//# constant JOIN
//#   fidelity: exact
#define JOIN 0xEFL

//# constant LISTEN
//#   fidelity: exact
#define LISTEN 0xE7L

//# constant PATH
//#   fidelity: exact
#define PATH 0xEBL

//# constant POLL
//#   fidelity: exact
#define POLL 0xECL

//# constant RECV
//#   fidelity: exact
#define RECV 0xE9L

//# constant REPLY
//#   fidelity: exact
#define REPLY 0xE5L

//# constant SEND
//#   fidelity: exact
#define SEND 0xEAL

//# constant SET
//#   fidelity: exact
#define SET 0xEDL

//# constant AP
//#   fidelity: exact
#define AP 0xF3L

//# constant CMD
//#   fidelity: exact
#define CMD 0xFEL

//# constant GET
//#   fidelity: exact
#define GET 71L

//# constant HTTP
//#   fidelity: exact
#define HTTP 0xF7L

//# constant POST
//#   fidelity: exact
#define POST 80L

//# constant STA
//#   fidelity: exact
#define STA 0xF4L

//# constant STA_AP
//#   fidelity: exact
#define STA_AP 0xF2L

//# constant TCP
//#   fidelity: exact
#define TCP 0xF5L

//# constant WS
//#   fidelity: exact
#define WS 0xF6L

//# constant GPIO_DI
//#   fidelity: exact
#define GPIO_DI 1L

//# constant GPIO_DO
//#   fidelity: exact
#define GPIO_DO 3L

//# constant GPIO_RTS
//#   fidelity: exact
#define GPIO_RTS 15L

//# constant GPIO_CTS
//#   fidelity: exact
#define GPIO_CTS 13L

//# constant GPIO_ASC
//#   fidelity: exact
#define GPIO_ASC 5L

//# constant GPIO_DBG
//#   fidelity: exact
#define GPIO_DBG 2L

//# constant GPIO_PGM
//#   fidelity: exact
#define GPIO_PGM 0L

//# constant INVALID_REQUEST
//#   fidelity: exact
#define INVALID_REQUEST 1L

//# constant INVALID_ARGUMENT
//#   fidelity: exact
#define INVALID_ARGUMENT 2L

//# constant WRONG_ARGUMENT_COUNT
//#   fidelity: exact
#define WRONG_ARGUMENT_COUNT 3L

//# constant NO_FREE_LISTENER
//#   fidelity: exact
#define NO_FREE_LISTENER 4L

//# constant NO_FREE_CONNECTION
//#   fidelity: exact
#define NO_FREE_CONNECTION 5L

//# constant LOOKUP_FAILED
//#   fidelity: exact
#define LOOKUP_FAILED 6L

//# constant CONNECTION_FAILED
//#   fidelity: exact
#define CONNECTION_FAILED 7L

//# constant SEND_FAILED
//#   fidelity: exact
#define SEND_FAILED 8L

//# constant INVALID_STATE
//#   fidelity: exact
#define INVALID_STATE 9L

//# constant INVALID_SIZE
//#   fidelity: exact
#define INVALID_SIZE 10L

//# constant DISCONNECTED
//#   fidelity: exact
#define DISCONNECTED 11L

//# constant NOT_IMPLEMENTED_ERROR_12
//#   fidelity: exact
#define NOT_IMPLEMENTED_ERROR_12 12L

//# constant BUSY
//#   fidelity: exact
#define BUSY 13L

//# constant INTERNAL_ERROR
//#   fidelity: exact
#define INTERNAL_ERROR 14L

//# constant NO_ERROR
//#   fidelity: exact
#define NO_ERROR 0L

//# constant OUT_OF_MEMORY
//#   fidelity: exact
#define OUT_OF_MEMORY (-1L)

//# constant UNDEFINED_NEG2
//#   fidelity: exact
#define UNDEFINED_NEG2 (-2L)

//# constant TIMEOUT
//#   fidelity: exact
#define TIMEOUT (-3L)

//# constant ROUTING_PROBLEM
//#   fidelity: exact
#define ROUTING_PROBLEM (-4L)

//# constant OPERATION_IN_PROCESS
//#   fidelity: exact
#define OPERATION_IN_PROCESS (-5L)

//# constant UNDEFINED_NEG6
//#   fidelity: exact
#define UNDEFINED_NEG6 (-6L)

//# constant NUMBER_TOO_LARGE
//#   fidelity: exact
#define NUMBER_TOO_LARGE (-7L)

//# constant CONNECTION_ABORTED
//#   fidelity: exact
#define CONNECTION_ABORTED (-8L)

//# constant CONNECTION_RESET
//#   fidelity: exact
#define CONNECTION_RESET (-9L)

//# constant CONNECTION_CLOSED
//#   fidelity: exact
#define CONNECTION_CLOSED (-10L)

//# constant NOT_CONNECTED
//#   fidelity: exact
#define NOT_CONNECTED (-11L)

//# constant ILLEGAL_ARGUUMENT
//#   fidelity: exact
#define ILLEGAL_ARGUUMENT (-12L)

//# constant UNDEFINED_NEG13
//#   fidelity: exact
#define UNDEFINED_NEG13 (-13L)

//# constant UDP_SEND_ERROR
//#   fidelity: exact
#define UDP_SEND_ERROR (-14L)

//# constant ALREADY_CONNECTED
//#   fidelity: exact
#define ALREADY_CONNECTED (-15L)

//# constant SSL_HANDSHAKE_FAILED
//#   fidelity: exact
#define SSL_HANDSHAKE_FAILED (-28L)

//# constant SSL_APPLICATION_INVALID
//#   fidelity: exact
#define SSL_APPLICATION_INVALID (-61L)
