import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * A client of raycert: reads a case a line, answers each with a line, flushed, in order.
 *
 * <p>A double travels as a string of 16 hexadecimal digits, its bit pattern, because Java has no
 * JSON reader and this one would be longer if it read decimals. Any key order, blanks, escapes and
 * unknown fields are read. Infinity is null.
 */
public final class Tracer {

    record Vector(double x, double y, double z) {}

    /** origin + t direction, t >= 0. */
    record Ray(Vector origin, Vector direction) {}

    /** An interval of t. A list is sorted and disjoint; the last leave may be infinite. */
    record Pair(double enter, double leave) {}

    sealed interface Solid {}

    /** (x - point) . normal <= 0. */
    record HalfSpace(Vector point, Vector normal) implements Solid {}

    record Sphere(Vector center, double radius) implements Solid {}

    record InfiniteCylinder(Vector p, Vector q, double radius) implements Solid {}

    record Slab(Vector p, Vector q) implements Solid {}

    record Cylinder(Vector p, Vector q, double radius) implements Solid {}

    record Union(List<Solid> of) implements Solid {}

    record Intersection(List<Solid> of) implements Solid {}

    /** The first, less all the others. */
    record Difference(List<Solid> of) implements Solid {}

    /** A solid of a type that this client does not have; the message is its type, quoted. */
    static final class Unsupported extends RuntimeException {
        private static final long serialVersionUID = 1;

        Unsupported(String type) {
            super(type);
        }
    }

    /** Only so that it can be replaced as one piece. */
    static final class Yours {
        // ---- your tracer: replace from here ------------------------------------------------
        // What you declare, and the function `intersect`. Leave out the solids you do not have.
        //
        // What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis
        // and direction are scaled by powers of two, which is exact, and no formula subtracts what
        // nearly cancels. Java rounds every operation as it is written; leave Math.fma out of it.

        static final String HELLO = """
                {"hello": 1, "name": "reference tracer, in Java", "version": "1", \
                "solids": ["half_space", "sphere", "infinite_cylinder", "slab", "cylinder", \
                "union", "intersection", "difference"], \
                "precision": "binary64", "convention": "closed", "numbers": "bits"}""";

        /** The intervals of t >= 0 for which the ray is in the solid. */
        static List<Pair> intersect(Solid solid, Ray ray) {
            if (solid instanceof HalfSpace s) return halfSpace(s, ray);
            if (solid instanceof Sphere s) return sphere(s, ray);
            if (solid instanceof InfiniteCylinder s) {
                return axial(s.p, s.q, s.radius, ray, true, false);
            }
            if (solid instanceof Slab s) return axial(s.p, s.q, 0, ray, false, true);
            if (solid instanceof Cylinder s) return axial(s.p, s.q, s.radius, ray, true, true);
            if (solid instanceof Union s) return union(each(s.of, ray));
            if (solid instanceof Intersection s) return each(s.of, ray).reduce(ALL, Yours::both);
            if (solid instanceof Difference s) {
                List<Solid> others = s.of.subList(1, s.of.size());
                return difference(intersect(s.of.get(0), ray), union(each(others, ray)));
            }
            throw new AssertionError(solid);
        }

        private static Stream<List<Pair>> each(List<Solid> parts, Ray ray) {
            return parts.stream().map(part -> intersect(part, ray));
        }

        private static List<Pair> halfSpace(HalfSpace s, Ray ray) {
            Scaled n = scaled(s.normal), v = scaled(ray.direction);
            Scaled y = displacement(s.point, ray.origin);
            double up = dot(y.m, n.m), vn = dot(v.m, n.m);
            if (vn == 0 || (vn > 0) == (up > 0)) {
                return up <= 0 ? ALL : NONE; // it never comes to the plane
            }
            double t = times(-up / vn, y.e - v.e);
            return vn > 0 ? pair(0, t) : pair(t, Double.POSITIVE_INFINITY);
        }

        private static List<Pair> sphere(Sphere s, Ray ray) {
            Scaled v = scaled(ray.direction), y = displacement(s.center, ray.origin);
            int e = Math.max(y.e, exponent(s.radius));
            double r = Math.scalb(s.radius, -e);
            return unscale(chord(shift(y.m, y.e - e), v.m, r), e - v.e);
        }

        /**
         * Where the ray is within the wall around pq, between the caps, or both.
         *
         * <p>Lengths from p and q are scaled by one power of two, v by another, w = q - p by a
         * third: no product overflows, and t only has to be scaled back.
         */
        private static List<Pair> axial(
                Vector p, Vector q, double radius, Ray ray, boolean wall, boolean caps) {
            Scaled v = scaled(ray.direction), w = displacement(p, q);
            Scaled fromP = displacement(p, ray.origin), fromQ = displacement(q, ray.origin);
            int e = Math.max(Math.max(fromP.e, fromQ.e), exponent(radius));
            Vector y = shift(fromP.m, fromP.e - e), z = shift(fromQ.m, fromQ.e - e);
            List<Pair> pairs = caps ? slab(y, z, v.m, w.m) : ALL;
            if (wall) {
                // Crossed with w, which is not normalised: r is multiplied by |w| instead. So a
                // direction parallel to the axis gives exactly zero, however the axis points.
                double r = Math.scalb(radius, -e) * norm(w.m);
                pairs = both(chord(cross(y, w.m), cross(v.m, w.m), r), pairs);
            }
            return unscale(pairs, e - v.e);
        }

        /** Between the planes through p and q square to pq: y, z are the start from p and q. */
        private static List<Pair> slab(Vector y, Vector z, Vector v, Vector w) {
            double up = -dot(y, w), uq = -dot(z, w), vn = -dot(v, w);
            if (vn == 0) return up <= 0 && 0 <= uq ? ALL : NONE;
            double tp = -up / vn, tq = -uq / vn;
            if (uq < 0) return vn > 0 ? pair(tq, tp) : NONE; // it starts beyond q
            if (up > 0) return vn < 0 ? pair(tp, tq) : NONE; // it starts before p
            return pair(0, vn > 0 ? tp : tq);
        }

        /** Where |y + t v| <= r: across an axis, or about a center. */
        private static List<Pair> chord(Vector y, Vector v, double r) {
            double a = dot(v, v), b = dot(v, y);
            if (a == 0) return norm(y) <= r ? ALL : NONE;
            double reach = r * norm(v), offset = norm(cross(v, y));
            if (reach < offset) return NONE;
            // The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a
            // tangency. Likewise |y|^2 - r^2 near the wall; norm(y) = r gives t = 0 itself.
            double half = Math.sqrt((reach - offset) * (reach + offset));
            double c = (norm(y) - r) * (norm(y) + r);

            // The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is
            // c / k, k the numerator of the other. Only where 2 half > |b| does it cancel much;
            // elsewhere c / k is the worse one. Near a tangent start that can even pass the other
            // root: it is stopped there.
            double t1 = (-b - half) / a, t2 = (-b + half) / a;
            if (2 * half > Math.abs(b)) {
                if (b > 0) t2 = Math.max(t1, c / (-b - half));
                else t1 = Math.min(t2, c / (-b + half));
            }
            return pair(t1 < 0 ? 0 : t1, t2);
        }

        // ---- lists of closed intervals: only compared, so nothing is rounded here

        private static final List<Pair> NONE = List.of();
        private static final List<Pair> ALL = List.of(new Pair(0, Double.POSITIVE_INFINITY));

        /** An interval that would end before it begins is none. */
        private static List<Pair> pair(double enter, double leave) {
            return enter <= leave ? List.of(new Pair(enter, leave)) : NONE;
        }

        /** The t in any of the lists. Intervals that touch merge. */
        private static List<Pair> union(Stream<List<Pair>> lists) {
            List<Pair> merged = new ArrayList<>();
            Comparator<Pair> byEnter = Comparator.comparingDouble(Pair::enter);
            lists.flatMap(List::stream).sorted(byEnter).forEachOrdered(next -> {
                int end = merged.size() - 1;
                if (end >= 0 && next.enter <= merged.get(end).leave) {
                    Pair last = merged.get(end);
                    merged.set(end, new Pair(last.enter, Math.max(last.leave, next.leave)));
                } else {
                    merged.add(next);
                }
            });
            return merged;
        }

        private static List<Pair> both(List<Pair> one, List<Pair> other) {
            List<Pair> common = new ArrayList<>();
            for (Pair a : one) {
                for (Pair b : other) {
                    common.addAll(pair(Math.max(a.enter, b.enter), Math.min(a.leave, b.leave)));
                }
            }
            return common;
        }

        /** The closure of the first without the holes: cutting out a single point leaves it in. */
        private static List<Pair> difference(List<Pair> left, List<Pair> holes) {
            for (Pair hole : holes) {
                List<Pair> rest = new ArrayList<>();
                for (Pair a : left) {
                    if (a.enter < hole.enter) {
                        rest.add(new Pair(a.enter, Math.min(a.leave, hole.enter)));
                    }
                    if (hole.leave < a.leave) {
                        rest.add(new Pair(Math.max(a.enter, hole.leave), a.leave));
                    }
                }
                left = rest;
            }
            return union(Stream.of(left));
        }

        private static List<Pair> unscale(List<Pair> pairs, int e) {
            return pairs.stream().map(t -> new Pair(times(t.enter, e), times(t.leave, e))).toList();
        }

        // ---- vectors, and their exact scaling by powers of two

        private static double dot(Vector a, Vector b) {
            return a.x * b.x + a.y * b.y + a.z * b.z;
        }

        /** Exactly zero for parallel vectors of any length, as equal products round alike. */
        private static Vector cross(Vector a, Vector b) {
            return new Vector(
                    a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        }

        /**
         * |a|, exact along a coordinate axis. Not Math.hypot, which is for two numbers only: the
         * squares of a scaled vector neither overflow nor lose anything. In the last bit it may
         * differ from the hypot of the reference.
         */
        private static double norm(Vector a) {
            Scaled s = scaled(a);
            return Math.scalb(Math.sqrt(dot(s.m, s.m)), s.e);
        }

        /** The e for which |x| is in [1/2, 1) 2^e; for zero, below that of every double. */
        private static int exponent(double x) {
            if (x == 0) return -1200;
            int e = Math.getExponent(x);
            return e < Double.MIN_EXPONENT ? Math.getExponent(x * 0x1p54) - 53 : e + 1;
        }

        private static Vector shift(Vector a, int e) {
            return new Vector(Math.scalb(a.x, e), Math.scalb(a.y, e), Math.scalb(a.z, e));
        }

        /** A vector as m 2^e, the largest component of m in [1/2, 1). */
        private record Scaled(Vector m, int e) {}

        private static Scaled scaled(Vector a) {
            int e = Math.max(exponent(a.x), Math.max(exponent(a.y), exponent(a.z)));
            return new Scaled(shift(a, -e), e);
        }

        /** end - start. One that overflows is taken again between the halves. */
        private static Scaled displacement(Vector start, Vector end) {
            Vector d = new Vector(end.x - start.x, end.y - start.y, end.z - start.z);
            if (Double.isInfinite(d.x) || Double.isInfinite(d.y) || Double.isInfinite(d.z)) {
                Scaled half = displacement(shift(start, -1), shift(end, -1));
                return new Scaled(half.m, half.e + 1);
            }
            return scaled(d);
        }

        /** t 2^e for t >= 0, and never -0. */
        private static double times(double t, int e) {
            return Math.scalb(t, e) + 0.0;
        }

        // ---- to here -----------------------------------------------------------------------
    }

    /** A JSON value: its text as it stands in the line, and the values in it. */
    record Value(String text, Map<String, Value> fields, List<Value> items) {
        private static final Pattern BITS = Pattern.compile("\"[0-9a-fA-F]{16}\"");

        Value at(String name) {
            Value value = fields.get(name);
            if (value == null) throw new IllegalArgumentException(name + " is missing");
            return value;
        }

        double number() {
            if (!BITS.matcher(text).matches()) {
                throw new IllegalArgumentException("a number is not 16 hexadecimal digits");
            }
            double x = Double.longBitsToDouble(Long.parseUnsignedLong(text, 1, 17, 16));
            if (!Double.isFinite(x)) throw new IllegalArgumentException("a number is not finite");
            return x;
        }

        Vector vector() {
            if (items.size() != 3) {
                throw new IllegalArgumentException("a vector has not three numbers");
            }
            return new Vector(items.get(0).number(), items.get(1).number(), items.get(2).number());
        }

        Solid solid() {
            String type = Reader.unescaped(at("type").text);
            return switch (type) {
                case "half_space" -> new HalfSpace(at("point").vector(), at("normal").vector());
                case "sphere" -> new Sphere(at("center").vector(), at("radius").number());
                case "infinite_cylinder" ->
                        new InfiniteCylinder(p(), q(), at("radius").number());
                case "slab" -> new Slab(p(), q());
                case "cylinder" -> new Cylinder(p(), q(), at("radius").number());
                case "union" -> new Union(parts());
                case "intersection" -> new Intersection(parts());
                case "difference" -> new Difference(parts());
                default -> throw new Unsupported(at("type").text);
            };
        }

        private Vector p() {
            return at("p").vector();
        }

        private Vector q() {
            return at("q").vector();
        }

        private List<Solid> parts() {
            List<Value> parts = at("of").items;
            if (parts.isEmpty()) throw new IllegalArgumentException("a tree has no parts");
            return parts.stream().map(Value::solid).toList();
        }
    }

    /** Reads one line of JSON. */
    static final class Reader {
        private static final int DEEPEST = 1000; // what is nested deeper is an error, not a crash
        private final String line;
        private int at;

        Reader(String line) {
            this.line = line;
        }

        Value whole() {
            Value value = value(DEEPEST);
            if (peek() != 0) throw new IllegalArgumentException("the line goes on after its value");
            return value;
        }

        /** The next character that is not blank, 0 at the end. */
        private char peek() {
            while (at < line.length() && " \t\r\n".indexOf(line.charAt(at)) >= 0) at++;
            return at < line.length() ? line.charAt(at) : 0;
        }

        private boolean skip(char wanted) {
            boolean there = peek() == wanted;
            if (there) at++;
            return there;
        }

        private Value value(int depth) {
            if (depth == 0) throw new IllegalArgumentException("the line is nested too deep");
            Map<String, Value> fields = new LinkedHashMap<>();
            List<Value> items = new ArrayList<>();
            char first = peek();
            int begin = at;
            if (first == '{' || first == '[') members(fields, items, depth - 1);
            else if (first == '"') string();
            else while (at < line.length() && " \t\r,:]}".indexOf(line.charAt(at)) < 0) at++;
            if (at == begin) throw new IllegalArgumentException("the line is not JSON");
            return new Value(line.substring(begin, at), fields, items);
        }

        private void members(Map<String, Value> fields, List<Value> items, int depth) {
            boolean keyed = line.charAt(at++) == '{';
            char close = keyed ? '}' : ']';
            if (skip(close)) return;
            do {
                String key = keyed ? unescaped(value(depth).text) : null;
                if (keyed && !skip(':')) throw new IllegalArgumentException("the line is not JSON");
                Value value = value(depth);
                if (keyed) fields.put(key, value);
                else items.add(value);
            } while (skip(','));
            if (!skip(close)) throw new IllegalArgumentException("the line is not JSON");
        }

        private void string() {
            for (at++; at < line.length() && line.charAt(at) != '"'; at++) {
                if (line.charAt(at) == '\\') at++;
            }
            if (at++ >= line.length()) throw new IllegalArgumentException("a string does not end");
        }

        /** The text in the quotes. A control character that is escaped becomes '?'. */
        static String unescaped(String quoted) {
            if (!quoted.startsWith("\"")) throw new IllegalArgumentException("not a string");
            StringBuilder text = new StringBuilder();
            for (int i = 1; i < quoted.length() - 1; i++) {
                char c = quoted.charAt(i);
                if (c == '\\') {
                    c = quoted.charAt(++i);
                    if (c == 'u') {
                        c = (char) Integer.parseInt(quoted, i + 1, i + 5, 16);
                        i += 4;
                    } else if ("bfnrt".indexOf(c) >= 0) {
                        c = '?';
                    }
                }
                text.append(c);
            }
            return text.toString();
        }
    }

    private static String spelled(double t) {
        return Double.isInfinite(t) ? "null" : "\"%016x\"".formatted(Double.doubleToLongBits(t));
    }

    private static String spelled(List<Pair> pairs) {
        return pairs.stream()
                .map(pair -> "[" + spelled(pair.enter) + ", " + spelled(pair.leave) + "]")
                .collect(Collectors.joining(", ", "[", "]"));
    }

    private static String answer(String line) {
        String id = ""; // given back as it came
        try {
            Value form = new Reader(line).whole();
            if (form.fields.containsKey("hello")) return Yours.HELLO;
            id = "\"id\": " + form.at("id").text + ", ";
            Solid solid = form.at("solid").solid();
            Value ray = form.at("ray");
            Ray asked = new Ray(ray.at("origin").vector(), ray.at("direction").vector());
            return "{" + id + "\"intervals\": " + spelled(Yours.intersect(solid, asked)) + "}";
        } catch (Unsupported what) {
            return "{" + id + "\"unsupported\": " + what.getMessage() + "}";
        } catch (RuntimeException error) {
            error.printStackTrace();
            String why = String.valueOf(error.getMessage()).replaceAll("[^ -!#-\\[\\]-~]", "?");
            return "{" + id + "\"error\": \"" + why + "\"}";
        }
    }

    public static void main(String[] arguments) throws IOException {
        var in = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        var out = new PrintStream(System.out, false, StandardCharsets.UTF_8);
        for (String line = in.readLine(); line != null; line = in.readLine()) {
            out.print(answer(line) + "\n");
            out.flush();
        }
    }
}
