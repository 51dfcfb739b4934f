"""A deck written by pyNastran, and decks of the program read by it.

   exchange.py write DECK        a solid block with systems, loads and supports of many kinds, by the cards that pyNastran writes
   exchange.py loads DECK        the sum of the forces of each subcase, as pyNastran has it: ID FX FY FZ
   exchange.py read DECK         read it back: nodes and body elements
"""
import sys

from pyNastran.bdf.bdf import BDF, CaseControlDeck
from pyNastran.bdf.mesh_utils.loads import sum_forces_moments


def write(path):
    model = BDF(debug=None)
    model.sol = 101
    model.executive_control_lines = ['ID block,pyNastran', 'TIME 5', 'CEND']
    model.case_control_deck = CaseControlDeck(
        ['TITLE = WRITTEN BY PYNASTRAN', 'ECHO = NONE', 'SPC = 9']
        + [line for s in range(1, 9) for line in (
            'SUBCASE %d' % s, '  SUBTITLE=Case %d' % s, '  LOAD = %d' % s, '  DISPLACEMENT(SORT1,REAL)=ALL',
            '  STRESS(SORT1,REAL,VONMISES,CENTER)=ALL')], log=None)
    model.add_param('POST', [-1])
    model.add_param('PRTMAXIM', ['YES'])
    model.add_cord2r(7, [1., 2., 3.], [1., 3., 3.], [2., 2., 3.])
    model.add_cord2c(8, [-1., -1., 0.], [-1., -1., 2.], [1., -1., 0.], rid=7)
    model.add_cord1r(9, 101, 28, 1)
    node = lambda i, j, k: 1 + (i*3 + j)*3 + k
    for i in range(4):
        for j in range(3):
            for k in range(3):
                model.add_grid(node(i, j, k), [10.*i, 10.*j, 10.*k], cp=7, cd=7)
    model.add_grid(101, [5., 30., 2.], cp=8)
    element = 0
    for i in range(3):
        for j in range(2):
            for k in range(2):
                element += 1
                base = [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
                model.add_chexa(element, 1, base + [n + 1 for n in base])
    model.add_psolid(1, 1)
    model.add_psolid(2, 1)
    model.add_mat1(1, 9500., None, .25, rho=2.e-9)
    model.add_conrod(90, 1, [node(0, 0, 2), node(3, 2, 2)], A=4.)
    model.add_plotel(91, [1, 2])
    model.add_spc1(1, '123', [node(0, j, k) for j in range(3) for k in range(3)])
    model.add_spc(2, [node(3, 0, 0)], ['3'], [0.])
    model.add_spcadd(9, [1, 2])
    top = node(3, 2, 2)
    model.add_force(1, top, 5., [1., 2., 3.])
    model.add_force(2, top, 5., [1., 2., 3.], cid=7)
    model.add_force(3, top, 5., [1., 2., 3.], cid=9)
    model.add_force1(4, top, 5., node(0, 0, 0), node(3, 1, 2))
    model.add_force2(5, top, 5., node(0, 0, 0), node(3, 1, 2), node(0, 2, 0), node(3, 0, 2))
    model.add_pload4(6, [element], [1., 2., 3., 2.], top, node(2, 1, 2), nvector=[0., 0., 0.])
    model.add_pload4(7, [element], [2., 2., 2., 2.], top, node(2, 1, 2), nvector=[3., 0., 4.])
    for set_id, load in ((11, 1), (12, 2)):
        model.add_force(set_id, top, 7., [0., load, -1.])
    model.add_load(8, 2., [1., -.5], [11, 12])
    model.write_bdf(path, enddata=True)


def loads(path):
    model = BDF(debug=None)
    model.read_bdf(path)
    for s in sorted(model.subcases):
        if s == 0:
            continue
        force, _ = sum_forces_moments(model, [0., 0., 0.], model.subcases[s]['LOAD'][0])
        print(s, *force)


def read(path):
    model = BDF(debug=None)
    model.read_bdf(path)
    print(len(model.nodes), len([e for e in model.elements.values() if e.type in ('CHEXA', 'CPENTA', 'CTETRA')]))


{'write': write, 'loads': loads, 'read': read}[sys.argv[1]](sys.argv[2])
