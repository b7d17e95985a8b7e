"""The shrinker: simplest numbers, fewest parts, the same each time; a suspect case at any time."""

from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Difference, HalfSpace, Ray, Sphere, Union, leaves
from raycert.cases.numbers import Probe, numbers
from raycert.oracle.exact.trace import trace
from raycert.oracle.hunt.moves import Shrinker, cost, number_cost

FAR = Ray((0.1, -0.7, 12.3), (0.3, 0.21, -1.77))
BALL = Sphere((0.7, -0.3, 1.9), 1.234)
ROD = Cylinder((1.1, 2.2, 3.3), (-1.2, 0.1, -2.7), 0.77)
TREE = Probe(Difference((Union((ROD, BALL)), HalfSpace((0.1, 9.2, 0.3), (0.1, 0.9, 0.2)))), FAR)


def shrunk(probe, fails, most=6000):
    return Shrinker(probe, lambda probes: [fails(s) for s in probes], BINARY64, most).run()


def has_a_ball(probe):
    return any(isinstance(leaf, Sphere) for _, leaf in leaves(probe.solid))


def is_crossed(probe):
    found = trace(probe.solid, probe.ray).intervals
    return bool(found) and found[0][0].sign() > 0


def test_what_has_nothing_to_do_with_a_failure_goes():
    best = shrunk(TREE, has_a_ball)
    assert isinstance(best.solid, Sphere)
    assert not any(numbers(best))


def test_a_condition_on_the_answer_is_kept_in_small_numbers():
    best = shrunk(TREE, is_crossed)
    assert is_crossed(best)
    assert sum(1 for _ in leaves(best.solid)) == 1
    assert all(x in (-2, -1, 0, 1, 2) for x in numbers(best))
    assert best == shrunk(TREE, is_crossed)


def test_a_large_number_that_is_needed_becomes_a_power_of_two():
    best = shrunk(TREE, lambda s: any(abs(x) > 1e6 for x in s.ray.origin) or s == TREE)
    assert best == TREE or max(map(abs, best.ray.origin)) == 2.0**20


def test_a_shrink_that_is_broken_off_has_a_suspect_case():
    for most in (1, 50, 500):
        best = shrunk(TREE, is_crossed, most)
        assert best == TREE or is_crossed(best)
        assert cost(best) <= cost(TREE)


def test_nothing_that_passes_is_taken():
    assert shrunk(TREE, lambda probe: False) == TREE


def test_the_cost_orders_numbers_as_people_do():
    order = (0.0, 1.0, -1.0, 2.0, 4.0, 3.0, 5.0, 2.0**-10, 0.1)
    costs = [number_cost(x) for x in order]
    assert costs == sorted(costs)
