// Judge for XMI interoperability: loads a metamodel and models with the real Eclipse EMF (Debian's jars).
// See check.sh beside this file for how it is run, and emf_judge.py for the tests' own way: "--serve" answers one line of
// arguments, separated by tabs, after the other, so that one Java process serves a whole test run.
import java.io.*;
import java.nio.charset.StandardCharsets;
import java.nio.file.*;
import java.util.*;
import org.eclipse.emf.common.util.*;
import org.eclipse.emf.ecore.*;
import org.eclipse.emf.ecore.resource.*;
import org.eclipse.emf.ecore.resource.impl.ResourceSetImpl;
import org.eclipse.emf.ecore.util.*;
import org.eclipse.emf.ecore.xmi.*;
import org.eclipse.emf.ecore.xmi.impl.*;

public class EmfCheck {
    static int maxLines = 25;
    static int problems = 0;
    static boolean cpu = false; // whether times are processor times of all threads

    static long now() {
        return cpu ? ((com.sun.management.OperatingSystemMXBean) java.lang.management.ManagementFactory.getOperatingSystemMXBean()).getProcessCpuTime() : System.nanoTime();
    }

    static void say(String kind, String msg) {
        problems++;
        if (problems <= maxLines) System.out.println(kind + ": " + msg);
        else if (problems == maxLines + 1) System.out.println("... more");
    }

    static void leaves(String tag, Diagnostic d) {
        if (d.getSeverity() == Diagnostic.OK) return;
        if (d.getChildren().isEmpty()) {
            String sev = d.getSeverity() >= Diagnostic.ERROR ? "ERROR" : d.getSeverity() >= Diagnostic.WARNING ? "WARNING" : "INFO";
            say(tag + "-" + sev, d.getMessage());
        } else for (Diagnostic c : d.getChildren()) leaves(tag, c);
    }

    static ResourceSet newSet() {
        ResourceSet rs = new ResourceSetImpl();
        Map<String, Object> m = rs.getResourceFactoryRegistry().getExtensionToFactoryMap();
        m.put("ecore", new EcoreResourceFactoryImpl());
        m.put("*", new XMIResourceFactoryImpl());
        rs.getPackageRegistry().put(EcorePackage.eNS_URI, EcorePackage.eINSTANCE);
        // as Eclipse's registry has it
        EPackage xml = org.eclipse.emf.ecore.xml.namespace.XMLNamespacePackage.eINSTANCE;
        rs.getPackageRegistry().put(xml.getNsURI(), xml);
        rs.getLoadOptions().put(XMLResource.OPTION_RECORD_UNKNOWN_FEATURE, Boolean.FALSE);
        if (System.getenv("EMFCHECK_DEFER") != null) rs.getLoadOptions().put(XMLResource.OPTION_DEFER_IDREF_RESOLUTION, Boolean.TRUE);
        return rs;
    }

    static void register(ResourceSet rs, EPackage p) {
        if (p.getNsURI() == null) say("METAMODEL-ERROR", "package " + p.getName() + " has no nsURI");
        else rs.getPackageRegistry().put(p.getNsURI(), p);
        for (EPackage s : p.getESubpackages()) register(rs, s);
    }

    /** loads; load errors are reported, never thrown */
    static Resource load(ResourceSet rs, String file, String tag) {
        URI uri = URI.createFileURI(new File(file).getAbsoluteFile().toPath().normalize().toString());
        Resource known = rs.getResource(uri, false); // another metamodel may refer to this one, and has loaded it
        if (known != null && known.isLoaded()) return known;
        Resource r = rs.createResource(uri);
        try { r.load(rs.getLoadOptions()); }
        catch (Exception e) { Throwable c = e.getCause() != null ? e.getCause() : e; say(tag + "-LOAD", String.valueOf(c)); }
        for (Resource.Diagnostic d : r.getErrors()) say(tag + "-LOAD", "line " + d.getLine() + ": " + d.getMessage());
        for (Resource.Diagnostic d : r.getWarnings()) say(tag + "-LOADWARN", "line " + d.getLine() + ": " + d.getMessage());
        return r;
    }

    static void packages(EObject o, ResourceSet rs) { if (o instanceof EPackage) register(rs, (EPackage) o); }

    static String esc(String s) {
        StringBuilder b = new StringBuilder();
        s.codePoints().forEach(c -> { if (c < 32 || c == 92 || c > 126) b.append(String.format("\\u{%x}", c)); else b.appendCodePoint(c); });
        return b.toString();
    }

    /** position path of an object, the same rule as canon.py: /rootIndex/feature.index/... */
    static String path(EObject o, Map<EObject, String> memo) {
        String s = memo.get(o);
        if (s != null) return s;
        EObject c = o.eContainer();
        if (c == null) {
            Resource r = o.eResource();
            s = r == null ? (o.eIsProxy() ? "PROXY" : "NORES") : "/" + r.getContents().indexOf(o);
        } else {
            EStructuralFeature f = o.eContainingFeature();
            s = path(c, memo) + "/" + f.getName() + (f.isMany() ? "." + ((List<?>) c.eGet(f)).indexOf(o) : "");
        }
        memo.put(o, s);
        return s;
    }

    @SuppressWarnings("unchecked")
    static void canonKids(EObject o, String p, Map<EObject, String> memo) {
        for (EReference f : o.eClass().getEAllContainments()) {
            if (f.isMany()) { int i = 0; for (EObject k : (List<EObject>) o.eGet(f)) { String kp = p + "/" + f.getName() + "." + i++; memo.put(k, kp); canonKids(k, kp, memo); } }
            else { EObject k = (EObject) o.eGet(f); if (k != null) { String kp = p + "/" + f.getName(); memo.put(k, kp); canonKids(k, kp, memo); } }
        }
    }

    static String val(EStructuralFeature f, Object v, Map<EObject, String> memo) {
        if (v == null) return "null";
        if (f instanceof EReference) {
            EObject t = (EObject) v;
            if (t.eIsProxy()) return "PROXY " + EcoreUtil.getURI(t);
            return "@" + path(t, memo);
        }
        EDataType dt = (EDataType) f.getEType();
        if (v instanceof Double || v instanceof Float) return "f:" + Double.doubleToLongBits(((Number) v).doubleValue());
        if (v instanceof Date) return "d:" + ((Date) v).getTime();
        return esc(EcoreUtil.convertToString(dt, v));
    }

    static void canon(Resource r, PrintWriter w) {
        Map<EObject, String> memo = new IdentityHashMap<>();
        int i = 0;
        for (EObject root : r.getContents()) { String p = "/" + i++; memo.put(root, p); canonKids(root, p, memo); }
        for (Iterator<EObject> it = r.getAllContents(); it.hasNext();) {
            EObject o = it.next();
            w.println(path(o, memo) + " : " + o.eClass().getName());
            List<EStructuralFeature> fs = new ArrayList<>(o.eClass().getEAllStructuralFeatures());
            fs.sort(Comparator.comparing(EStructuralFeature::getName));
            for (EStructuralFeature f : fs) {
                if (f.isTransient() || f.isDerived()) continue;
                if (f instanceof EReference && (((EReference) f).isContainment() || ((EReference) f).isContainer())) continue;
                Object v = o.eGet(f);
                if (f.isMany()) {
                    List<?> l = (List<?>) v;
                    if (l.isEmpty()) continue;
                    StringJoiner b = new StringJoiner(" | ", "[", "]");
                    for (Object x : l) b.add(val(f, x, memo));
                    w.println("  " + f.getName() + " = " + b);
                } else if (v != null) w.println("  " + f.getName() + " = " + val(f, v, memo));
            }
        }
    }

    static class Exit extends RuntimeException {
        final int code;
        Exit(int code) { super(null, null, false, false); this.code = code; }
    }

    static void exit(int code) { throw new Exit(code); }

    public static void main(String[] a) throws Exception {
        if (a.length == 1 && a[0].equals("--serve")) {
            BufferedReader in = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
            for (String line; (line = in.readLine()) != null; ) {
                maxLines = 25; problems = 0;
                int code;
                try { judge(line.split("\t")); code = 0; }
                catch (Exit e) { code = e.code; }
                catch (Throwable t) { System.out.println("CRASH " + t); code = 4; }
                System.out.println("\u0004" + code);
                System.out.flush();
            }
            return;
        }
        try { judge(a); } catch (Exit e) { System.exit(e.code); }
    }

    static final Map<List<String>, ResourceSet> KEPT = new HashMap<>();

    /** metamodels that are known by their namespaces, as those of an Eclipse that has them installed */
    static ResourceSet metamodels(List<String> files, boolean validate) {
        ResourceSet rs = newSet();
        for (String file : files) for (EObject o : load(rs, file, "METAMODEL").getContents()) packages(o, rs);
        EcoreUtil.resolveAll(rs);
        for (Map.Entry<EObject, Collection<EStructuralFeature.Setting>> e : EcoreUtil.UnresolvedProxyCrossReferencer.find(rs).entrySet())
            say("METAMODEL-PROXY", EcoreUtil.getURI(e.getKey()).toString());
        for (Resource mm : rs.getResources()) for (EObject o : mm.getContents()) {
            if (validate) leaves("METAMODEL", Diagnostician.INSTANCE.validate(o));
            if (o instanceof EPackage && mm.getContents().get(0) == o) mm.setURI(URI.createURI(((EPackage) o).getNsURI()));
        }
        return rs;
    }

    /** the ASCII form of a text's output must not depend on the platform's encoding: problems are escaped where they are said */
    static void judge(String[] a) throws Exception {
        List<String> pos = new ArrayList<>();
        String resave = null, canonTo = null; int bench = 0; boolean validate = true, quiet = false, registered = false, keep = false;
        Map<URI, URI> places = new HashMap<>();
        for (int i = 0; i < a.length; i++) switch (a[i]) {
            case "--resave": resave = a[++i]; break;
            case "--canon": canonTo = a[++i]; break;
            case "--bench": bench = Integer.parseInt(a[++i]); break;
            case "--max": maxLines = Integer.parseInt(a[++i]); break;
            case "--no-validate": validate = false; break;
            case "--cpu": cpu = true; break;
            case "--registered": registered = true; break; // metamodels are known by their namespace, not as files
            case "--keep": keep = true; break; // as --registered; read once for all models of the process
            case "--map": places.put(URI.createURI(a[++i]), URI.createFileURI(new File(a[++i]).getAbsolutePath())); break; // where a namespace lies
            case "-q": quiet = true; break;
            default: pos.add(a[i]);
        }
        if (pos.isEmpty()) { System.err.println("usage: EmfCheck metamodel.ecore... [model.xmi] [--resave f] [--canon f] [--bench n] [--no-validate] [--cpu] [--max n] [-q]"); exit(2); }
        ResourceSet rs = newSet();
        rs.getURIConverter().getURIMap().putAll(places);
        String model = null;
        if (keep && pos.size() > 1) {
            model = pos.get(pos.size() - 1);
            List<String> files = pos.subList(0, pos.size() - 1);
            if (!KEPT.containsKey(files)) KEPT.put(new ArrayList<>(files), metamodels(files, validate));
            rs.getPackageRegistry().putAll(KEPT.get(files).getPackageRegistry());
        } else for (String p : pos) {
            if (p.endsWith(".ecore") && !(p.equals(pos.get(pos.size() - 1)) && pos.size() > 1 && model != null)) {
                Resource mm = load(rs, p, "METAMODEL");
                for (EObject o : mm.getContents()) packages(o, rs);
                EcoreUtil.resolveAll(mm);
                for (Map.Entry<EObject, Collection<EStructuralFeature.Setting>> e : EcoreUtil.UnresolvedProxyCrossReferencer.find(mm).entrySet())
                    say("METAMODEL-PROXY", EcoreUtil.getURI(e.getKey()).toString());
                if (validate) for (EObject o : mm.getContents()) leaves("METAMODEL", Diagnostician.INSTANCE.validate(o));
            } else model = p;
        }
        if (registered) for (Resource mm : rs.getResources()) if (!mm.getContents().isEmpty() && mm.getContents().get(0) instanceof EPackage)
            mm.setURI(URI.createURI(((EPackage) mm.getContents().get(0)).getNsURI()));
        if (model == null && resave != null) {
            Resource mm = rs.getResources().get(rs.getResources().size() - 1);
            for (Resource one : rs.getResources()) if (one.getURI().lastSegment().equals(new File(pos.get(pos.size() - 1)).getName())) mm = one;
            try (OutputStream os = new BufferedOutputStream(new FileOutputStream(resave))) { mm.save(os, null); }
            catch (Exception e) { say("METAMODEL-SAVE", String.valueOf(e.getCause() != null ? e.getCause() : e)); }
        }
        if (model == null) { System.out.println(problems == 0 ? "OK metamodel" : "BAD metamodel, " + problems + " diagnostics"); exit(problems == 0 ? 0 : 1); }

        long t0 = now();
        Resource r = load(rs, model, "MODEL");
        EcoreUtil.resolveAll(r);
        double loadS = (now() - t0) / 1e9;
        for (Map.Entry<EObject, Collection<EStructuralFeature.Setting>> e : EcoreUtil.UnresolvedProxyCrossReferencer.find(r).entrySet())
            say("MODEL-PROXY", EcoreUtil.getURI(e.getKey()) + " via " + e.getValue().iterator().next().getEStructuralFeature().getName());
        int n = 0; Map<String, Integer> count = new TreeMap<>();
        for (Iterator<EObject> it = r.getAllContents(); it.hasNext();) { EObject o = it.next(); n++; count.merge(o.eClass().getEPackage().getName() + "::" + o.eClass().getName(), 1, Integer::sum); }
        // single-valued cross references whose target is outside every resource (dangling): EMF would refuse to save
        if (validate) for (EObject o : r.getContents()) leaves("MODEL", Diagnostician.INSTANCE.validate(o));
        if (canonTo != null) try (PrintWriter w = new PrintWriter(new OutputStreamWriter(new BufferedOutputStream(new FileOutputStream(canonTo)), StandardCharsets.UTF_8))) { canon(r, w); }
        double saveS = 0;
        if (resave != null) {
            Map<Object, Object> o = new HashMap<>(); o.put(XMLResource.OPTION_ENCODING, "UTF-8");
            t0 = now();
            try (OutputStream os = new BufferedOutputStream(new FileOutputStream(resave))) { r.save(os, o); }
            catch (Exception e) { say("MODEL-SAVE", String.valueOf(e.getCause() != null ? e.getCause() : e)); }
            saveS = (now() - t0) / 1e9;
        }
        if (!quiet) for (Map.Entry<String, Integer> e : count.entrySet()) System.out.println("  " + e.getKey() + " " + e.getValue());
        for (int i = 0; i < bench; i++) {
            ResourceSet s = newSet(); for (Object p : rs.getPackageRegistry().values()) if (p instanceof EPackage) s.getPackageRegistry().put(((EPackage) p).getNsURI(), p);
            t0 = now();
            Resource q = s.getResource(URI.createFileURI(new File(model).getAbsoluteFile().toPath().normalize().toString()), true); EcoreUtil.resolveAll(q);
            double l = (now() - t0) / 1e9;
            t0 = now();
            ByteArrayOutputStream bo = new ByteArrayOutputStream(1 << 20); q.save(bo, null);
            double sv = (now() - t0) / 1e9;
            System.out.printf(Locale.ROOT, "bench %d: load %.3f s, save %.3f s, %d bytes%n", i, l, sv, bo.size());
        }
        System.out.printf(Locale.ROOT, "%s %d objects, %d roots, %d diagnostics (load %.3f s, save %.3f s)%n", problems == 0 ? "OK" : "BAD", n, r.getContents().size(), problems, loadS, saveS);
        exit(problems == 0 ? 0 : 1);
    }
}
