"""x"""
from robosmi.metamodels import migration
def bind_ports(program, api, connections, board, bind, limit): return []
