import java.util.List;
import java.util.ArrayList;
import java.util.function.DoublePredicate;
import java.util.stream.DoubleStream;

/**
 * What most adapters need between raycert and a library: take what yours asks for.
 *
 * <pre>
 * Frame, local, turned   its coordinates: p at the origin, the axis along z
 * shifted                the origin in the middle of the axis, for half heights
 * unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
 * farEnd                 its segment, past the solid: a fraction f of it is s = f length
 * paired                 its crossings, with its test of a point, as intervals
 * clipped                its intervals of a whole line, from 0 on
 * </pre>
 *
 * Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.
 */
final class Kit {
    private Kit() {}

    static Tracer.Vector minus(Tracer.Vector a, Tracer.Vector b) {
        return new Tracer.Vector(a.x() - b.x(), a.y() - b.y(), a.z() - b.z());
    }

    private static double dot(Tracer.Vector a, Tracer.Vector b) {
        return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
    }

    static double length(Tracer.Vector v) {
        return Math.hypot(Math.hypot(v.x(), v.y()), v.z());
    }

    static Tracer.Vector along(Tracer.Vector start, Tracer.Vector d, double s) {
        return new Tracer.Vector(
                start.x() + s * d.x(), start.y() + s * d.y(), start.z() + s * d.z());
    }

    /** A vector or point, and a length. */
    record Measured(Tracer.Vector vector, double length) {}

    /** v / |v|, and |v|; for the zero direction, which has no unit, itself and 0. */
    static Measured unit(Tracer.Vector v) {
        double l = length(v);
        if (l == 0) return new Measured(v, 0);
        return new Measured(new Tracer.Vector(v.x() / l, v.y() / l, v.z() / l), l);
    }

    /** Coordinates in which p is the origin and q is (0, 0, height). */
    record Frame(
            Tracer.Vector p, Tracer.Vector x, Tracer.Vector y, Tracer.Vector z, double height) {

        /** The frame of an axis: of one along a coordinate axis it is exact. */
        static Frame of(Tracer.Vector p, Tracer.Vector q) {
            Measured axis = unit(minus(q, p));
            double a = axis.vector.x(), b = axis.vector.y(), c = axis.vector.z();
            double s = c < 0 ? -1 : 1, k = -1 / (s + c);
            return new Frame(
                    p,
                    new Tracer.Vector(1 + s * a * a * k, s * a * b * k, -s * a),
                    new Tracer.Vector(a * b * k, s + b * b * k, -b),
                    axis.vector,
                    axis.length);
        }

        /** A direction in these coordinates. */
        Tracer.Vector turned(Tracer.Vector v) {
            return new Tracer.Vector(dot(x, v), dot(y, v), dot(z, v));
        }

        /** A point in these coordinates: from p first, then turned. */
        Tracer.Vector local(Tracer.Vector point) {
            return turned(minus(point, p));
        }

        /** A local point seen from the middle of the axis; the half height is height / 2. */
        Tracer.Vector shifted(Tracer.Vector point) {
            return new Tracer.Vector(point.x(), point.y(), point.z() - height / 2);
        }
    }

    /**
     * The end of a segment from start along the unit d, and its length. It ends beyond a solid
     * within `size` of the origin; the length is a power of two: no fraction of it rounds.
     */
    static Measured farEnd(Tracer.Vector start, Tracer.Vector d, double size) {
        double far = Math.scalb(4, Math.getExponent(length(start) + size));
        return new Measured(along(start, d, far), far);
    }

    /**
     * The intervals within [0, far] that crossings bound, in any order, doubled or not.
     *
     * <p>Crossings that bound nothing do no harm: those of all the planes and walls of a solid
     * will do. Whether the ray is inside between two is asked of two points there, as one may be
     * where it grazes; before the first and after the last of the start and the far end too. What
     * is inside up to `far` is endless; a crossing that is inside, with nothing inside on either
     * side, is a touch. `inside` has to take what is within a rounding of the boundary for inside,
     * or a chord that grazes falls apart.
     */
    static List<Tracer.Pair> paired(double[] crossings, double far, DoublePredicate inside) {
        double[] ends = DoubleStream.of(crossings).filter(s -> 0 <= s && s < far).toArray();
        double[] knots =
                DoubleStream.concat(DoubleStream.of(0, far), DoubleStream.of(ends))
                        .map(s -> s + 0.0) // no -0, which sorts apart
                        .sorted()
                        .distinct()
                        .toArray();
        boolean before = false;
        boolean crossed = DoubleStream.of(ends).anyMatch(s -> s == 0); // whether a knot is one
        List<Tracer.Pair> found = new ArrayList<>();
        for (int i = 0; i + 1 < knots.length; i++, crossed = true) {
            double a = knots[i], b = knots[i + 1], leave = b < far ? b : Double.POSITIVE_INFINITY;
            boolean now = inside.test(a + 0.375 * (b - a)) && inside.test(a + 0.625 * (b - a))
                    && (a > 0 || inside.test(a)) && (b < far || inside.test(b));
            if (now && before) {
                found.add(new Tracer.Pair(found.remove(found.size() - 1).enter(), leave));
            } else if (now) {
                found.add(new Tracer.Pair(a, leave));
            } else if (!before && crossed && inside.test(a)) {
                found.add(new Tracer.Pair(a, a));
            }
            before = now;
        }
        return found;
    }

    /** The part with t >= 0 of intervals of a whole line. */
    static List<Tracer.Pair> clipped(List<Tracer.Pair> pairs) {
        return pairs.stream()
                .filter(pair -> pair.leave() >= 0)
                .map(pair -> new Tracer.Pair(Math.max(pair.enter(), 0), pair.leave()))
                .toList();
    }

    /** Distances along a unit direction, as the t of a direction of this length. */
    static List<Tracer.Pair> rescaled(List<Tracer.Pair> pairs, double length) {
        return pairs.stream()
                .map(pair -> new Tracer.Pair(pair.enter() / length, pair.leave() / length))
                .toList();
    }
}
